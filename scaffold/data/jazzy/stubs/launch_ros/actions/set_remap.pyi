from launch.action import Action as Action
from launch.condition import Condition
from launch.some_substitutions_type import (
    SomeSubstitutionsType as SomeSubstitutionsType,
)
from launch.substitution import Substitution as Substitution

class SetRemap(Action):
    def __init__(
        self,
        src: SomeSubstitutionsType,
        dst: SomeSubstitutionsType,
        *,
        condition: Condition | None = None,
    ) -> None: ...
    @property
    def src(self) -> list[Substitution]: ...
    @property
    def dst(self) -> list[Substitution]: ...
