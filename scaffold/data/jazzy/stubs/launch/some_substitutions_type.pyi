from collections.abc import Iterable
from pathlib import Path
from typing import Any, TypeAlias

from launch.substitution import Substitution as Substitution

SomeSubstitutionsType: TypeAlias = str | Path | Substitution | Iterable[str | Path | Substitution]
SomeSubstitutionsType_types_tuple: tuple[Any, ...]
