from launch.some_substitutions_type import SomeSubstitutionsType as SomeSubstitutionsType
from launch.substitution import Substitution as Substitution
from launch.frontend import expose_substitution as expose_substitution
from launch.launch_context import LaunchContext as LaunchContext
from launch.substitutions.substitution_failure import SubstitutionFailure as SubstitutionFailure
from launch.utilities import (
    normalize_to_list_of_substitutions as normalize_to_list_of_substitutions,
)
from launch.utilities import perform_substitutions as perform_substitutions

class Parameter(Substitution):
    def __init__(self, name: SomeSubstitutionsType) -> None: ...
    @property
    def name(self) -> list[Substitution]: ...
