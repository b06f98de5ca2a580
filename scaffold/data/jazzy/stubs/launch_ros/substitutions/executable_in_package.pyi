from launch.some_substitutions_type import (
    SomeSubstitutionsType as SomeSubstitutionsType,
)
from launch.substitution import Substitution as Substitution
from launch_ros.substitutions.find_package import FindPackagePrefix

class ExecutableInPackage(FindPackagePrefix):
    def __init__(
        self, executable: SomeSubstitutionsType, package: SomeSubstitutionsType
    ) -> None: ...
    @property
    def executable(self) -> list[Substitution]: ...
