from launch.condition import Condition as Condition
from launch.some_substitutions_type import SomeSubstitutionsType as SomeSubstitutionsType
from ..launch_context import LaunchContext as LaunchContext
from ..utilities import normalize_to_list_of_substitutions as normalize_to_list_of_substitutions
from ..utilities import perform_substitutions as perform_substitutions

class LaunchConfigurationEquals(Condition):
    def __init__(
        self, launch_configuration_name: str, expected_value: SomeSubstitutionsType | None
    ) -> None: ...
