from launch.action import Action as Action
from launch.condition import Condition
from launch.some_substitutions_type import (
    SomeSubstitutionsType as SomeSubstitutionsType,
)
from launch.substitution import Substitution as Substitution

class SetLaunchConfiguration(Action):
    def __init__(
        self,
        name: SomeSubstitutionsType,
        value: SomeSubstitutionsType,
        *,
        condition: Condition | None = None,
    ) -> None: ...
    @property
    def name(self) -> list[Substitution]: ...
    @property
    def value(self) -> list[Substitution]: ...
