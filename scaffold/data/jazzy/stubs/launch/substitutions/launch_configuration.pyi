from typing import Any

from launch.some_substitutions_type import (
    SomeSubstitutionsType as SomeSubstitutionsType,
)
from launch.substitution import Substitution as Substitution

class LaunchConfiguration(Substitution):
    def __init__(self, variable_name: SomeSubstitutionsType, *, default: Any = None) -> None: ...
    @property
    def variable_name(self) -> list[Substitution]: ...
