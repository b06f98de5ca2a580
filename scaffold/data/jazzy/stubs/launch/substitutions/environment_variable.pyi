from launch.some_substitutions_type import (
    SomeSubstitutionsType as SomeSubstitutionsType,
)
from launch.substitution import Substitution as Substitution

class EnvironmentVariable(Substitution):
    def __init__(
        self, name: SomeSubstitutionsType, *, default_value: SomeSubstitutionsType | None = None
    ) -> None: ...
    @property
    def name(self) -> list[Substitution]: ...
    @property
    def default_value(self) -> list[Substitution] | None: ...
