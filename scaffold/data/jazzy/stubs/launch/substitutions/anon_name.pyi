from launch.some_substitutions_type import (
    SomeSubstitutionsType as SomeSubstitutionsType,
)
from launch.substitution import Substitution as Substitution

class AnonName(Substitution):
    def __init__(self, name: SomeSubstitutionsType) -> None: ...
    @property
    def name(self) -> list[Substitution]: ...
    def compute_name(self, id_value: str) -> str: ...
