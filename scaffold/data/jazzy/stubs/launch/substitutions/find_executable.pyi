from launch.some_substitutions_type import (
    SomeSubstitutionsType as SomeSubstitutionsType,
)
from launch.substitution import Substitution as Substitution

class FindExecutable(Substitution):
    def __init__(self, *, name: SomeSubstitutionsType) -> None: ...
    @property
    def name(self) -> list[Substitution]: ...
