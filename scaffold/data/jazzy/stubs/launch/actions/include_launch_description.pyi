from collections.abc import Iterable, Sequence

from launch.action import Action as Action
from launch.condition import Condition
from launch.launch_description_source import (
    LaunchDescriptionSource as LaunchDescriptionSource,
)
from launch.some_substitutions_type import (
    SomeSubstitutionsType as SomeSubstitutionsType,
)

class IncludeLaunchDescription(Action):
    def __init__(
        self,
        launch_description_source: LaunchDescriptionSource | SomeSubstitutionsType,
        *,
        launch_arguments: Iterable[tuple[SomeSubstitutionsType, SomeSubstitutionsType]]
        | None = None,
        condition: Condition | None = None,
    ) -> None: ...
    @property
    def launch_description_source(self) -> LaunchDescriptionSource: ...
    @property
    def launch_arguments(self) -> Sequence[tuple[SomeSubstitutionsType, SomeSubstitutionsType]]: ...
