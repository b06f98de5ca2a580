from launch.action import Action as Action
from launch.condition import Condition
from launch.some_substitutions_type import (
    SomeSubstitutionsType as SomeSubstitutionsType,
)

class SetParametersFromFile(Action):
    def __init__(
        self, filename: SomeSubstitutionsType, *, condition: Condition | None = None
    ) -> None: ...
