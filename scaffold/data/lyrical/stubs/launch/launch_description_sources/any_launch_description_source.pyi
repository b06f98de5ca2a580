from launch.launch_description_source import LaunchDescriptionSource
from launch.some_substitutions_type import SomeSubstitutionsType as SomeSubstitutionsType
from .any_launch_file_utilities import (
    get_launch_description_from_any_launch_file as get_launch_description_from_any_launch_file,
)
from ..launch_description import LaunchDescription as LaunchDescription

class AnyLaunchDescriptionSource(LaunchDescriptionSource):
    def __init__(self, launch_file_path: SomeSubstitutionsType) -> None: ...
