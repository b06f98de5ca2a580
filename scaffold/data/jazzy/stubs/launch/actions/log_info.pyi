from launch.action import Action as Action
from launch.condition import Condition
from launch.some_substitutions_type import (
    SomeSubstitutionsType as SomeSubstitutionsType,
)
from launch.substitution import Substitution as Substitution

class LogInfo(Action):
    def __init__(
        self,
        *,
        msg: SomeSubstitutionsType,
        condition: Condition | None = None,
    ) -> None: ...
    @property
    def msg(self) -> list[Substitution]: ...
