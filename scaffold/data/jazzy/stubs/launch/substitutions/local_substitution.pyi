from launch.some_substitutions_type import (
    SomeSubstitutionsType as SomeSubstitutionsType,
)
from launch.substitution import Substitution as Substitution

class LocalSubstitution(Substitution):
    def __init__(self, expression: str, description: str | None = None) -> None: ...
    @property
    def expression(self) -> str: ...
    @property
    def description(self) -> str | None: ...
