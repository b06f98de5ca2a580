from typing import Any

from launch.some_substitutions_type import (
    SomeSubstitutionsType as SomeSubstitutionsType,
)
from launch.substitution import Substitution as Substitution

class Parameter(Substitution):
    def __init__(self, name: SomeSubstitutionsType, *, default: Any = None) -> None: ...
    @property
    def name(self) -> list[Substitution]: ...
