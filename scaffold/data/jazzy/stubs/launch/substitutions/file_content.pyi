from launch.some_substitutions_type import (
    SomeSubstitutionsType as SomeSubstitutionsType,
)
from launch.substitution import Substitution as Substitution

class FileContent(Substitution):
    def __init__(self, path: SomeSubstitutionsType) -> None: ...
    @property
    def path(self) -> list[Substitution]: ...
