from collections.abc import Iterable
from typing import Any, TypeAlias

from launch.some_substitutions_type import (
    SomeSubstitutionsType as SomeSubstitutionsType,
)

SomeRemapRule: TypeAlias = tuple[SomeSubstitutionsType, SomeSubstitutionsType]
SomeRemapRules: TypeAlias = Iterable[SomeRemapRule]
RemapRule: TypeAlias = Any
RemapRules: TypeAlias = Iterable[Any]
