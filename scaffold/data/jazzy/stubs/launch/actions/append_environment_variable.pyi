from launch.action import Action as Action
from launch.condition import Condition
from launch.some_substitutions_type import (
    SomeSubstitutionsType as SomeSubstitutionsType,
)
from launch.substitution import Substitution as Substitution

class AppendEnvironmentVariable(Action):
    def __init__(
        self,
        name: SomeSubstitutionsType,
        value: SomeSubstitutionsType,
        prepend: bool | SomeSubstitutionsType = False,
        separator: SomeSubstitutionsType = ...,
        *,
        condition: Condition | None = None,
    ) -> None: ...
    @property
    def name(self) -> list[Substitution]: ...
    @property
    def value(self) -> list[Substitution]: ...
    @property
    def prepend(self) -> bool | list[Substitution]: ...
    @property
    def separator(self) -> list[Substitution]: ...
