from collections.abc import Iterable, Sequence
from launch.action import Action as Action
from launch.condition import Condition
from launch.launch_description_source import LaunchDescriptionSource as LaunchDescriptionSource
from launch.some_substitutions_type import SomeSubstitutionsType as SomeSubstitutionsType
from typing import Any
from typing import Text
from .opaque_function import OpaqueFunction as OpaqueFunction
from .set_launch_configuration import SetLaunchConfiguration as SetLaunchConfiguration
from ..frontend import Entity as Entity
from ..frontend import expose_action as expose_action
from ..frontend import Parser as Parser
from ..launch_context import LaunchContext as LaunchContext
from ..launch_description_entity import LaunchDescriptionEntity as LaunchDescriptionEntity
from ..launch_description_sources import AnyLaunchDescriptionSource as AnyLaunchDescriptionSource
from ..utilities import normalize_to_list_of_substitutions as normalize_to_list_of_substitutions
from ..utilities import perform_substitutions as perform_substitutions

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
    _set_launch_file_location_locals: Any
    _restore_launch_file_location_locals: Any

    def __repr__(self) -> Text: ...
    __previous_launch_file_path: Any
    __previous_launch_file_dir: Any
