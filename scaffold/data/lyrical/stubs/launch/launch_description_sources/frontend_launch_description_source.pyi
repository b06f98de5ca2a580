from typing import Any
from launch.launch_description_source import LaunchDescriptionSource
from launch.some_substitutions_type import SomeSubstitutionsType as SomeSubstitutionsType
from .frontend_launch_file_utilities import (
    get_launch_description_from_frontend_launch_file as get_launch_description_from_frontend_launch_file,
)
from ..frontend import Parser as Parser
from ..launch_description import LaunchDescription as LaunchDescription

class FrontendLaunchDescriptionSource(LaunchDescriptionSource):
    def __init__(
        self,
        launch_file_path: SomeSubstitutionsType,
        *,
        method: str = "interpreted frontend launch file",
        parser: Any = ...,
    ) -> None: ...
