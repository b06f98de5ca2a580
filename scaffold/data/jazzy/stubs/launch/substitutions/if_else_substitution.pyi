from launch.some_substitutions_type import (
    SomeSubstitutionsType as SomeSubstitutionsType,
)
from launch.substitution import Substitution as Substitution

class IfElseSubstitution(Substitution):
    def __init__(
        self,
        condition: SomeSubstitutionsType,
        if_value: SomeSubstitutionsType = "",
        else_value: SomeSubstitutionsType = "",
    ) -> None: ...
    @property
    def condition(self) -> list[Substitution]: ...
    @property
    def if_value(self) -> list[Substitution]: ...
    @property
    def else_value(self) -> list[Substitution]: ...
