from typing import Any

from launch.some_substitutions_type import (
    SomeSubstitutionsType as SomeSubstitutionsType,
)
from launch.substitution import Substitution as Substitution

class EqualsSubstitution(Substitution):
    def __init__(self, left: Any, right: Any) -> None: ...
    @property
    def left(self) -> list[Substitution]: ...
    @property
    def right(self) -> list[Substitution]: ...
