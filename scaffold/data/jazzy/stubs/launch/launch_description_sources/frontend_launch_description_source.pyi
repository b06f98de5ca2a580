from typing import Any

from launch.launch_description_source import LaunchDescriptionSource
from launch.some_substitutions_type import (
    SomeSubstitutionsType as SomeSubstitutionsType,
)

class FrontendLaunchDescriptionSource(LaunchDescriptionSource):
    def __init__(
        self,
        launch_file_path: SomeSubstitutionsType,
        *,
        method: str = "interpreted frontend launch file",
        parser: Any = ...,
    ) -> None: ...
