from launch.some_substitutions_type import (
    SomeSubstitutionsType as SomeSubstitutionsType,
)
from launch.substitution import Substitution as Substitution
from launch.substitutions.path_join_substitution import PathJoinSubstitution

class LaunchLogDir(Substitution):
    def __init__(self) -> None: ...
    def __truediv__(self, additional_path: SomeSubstitutionsType) -> PathJoinSubstitution: ...
