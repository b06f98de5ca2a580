from collections.abc import Iterable

from _ros_launch import Listed
from launch.some_substitutions_type import (
    SomeSubstitutionsType as SomeSubstitutionsType,
)
from launch.substitution import Substitution as Substitution

class PathJoinSubstitution(Substitution):
    def __init__(self, substitutions: Listed[SomeSubstitutionsType]) -> None: ...
    @property
    def substitutions(self) -> Iterable[Substitution]: ...
    def __truediv__(self, additional_path: SomeSubstitutionsType) -> PathJoinSubstitution: ...

class PathSubstitution(PathJoinSubstitution):
    def __init__(self, path: SomeSubstitutionsType) -> None: ...
