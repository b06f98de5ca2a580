from launch.launch_description_sources.frontend_launch_description_source import (
    FrontendLaunchDescriptionSource,
)
from launch.some_substitutions_type import SomeSubstitutionsType

class XMLLaunchDescriptionSource(FrontendLaunchDescriptionSource):
    def __init__(self, launch_file_path: SomeSubstitutionsType) -> None: ...
