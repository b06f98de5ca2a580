from launch.launch_context import LaunchContext
from launch.launch_description import LaunchDescription
from launch.some_substitutions_type import SomeSubstitutionsType

class LaunchDescriptionSource:
    def __init__(
        self,
        launch_description: LaunchDescription | None = None,
        location: SomeSubstitutionsType = "<string>",
        method: str = "unspecified mechanism from a script",
    ) -> None: ...
    def try_get_launch_description_without_context(self) -> LaunchDescription | None: ...
    def get_launch_description(self, context: LaunchContext) -> LaunchDescription: ...
    @property
    def location(self) -> str: ...
    @property
    def method(self) -> str: ...
