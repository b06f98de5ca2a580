from collections.abc import Iterable
from typing import Any
from launch.action import Action as Action
from launch.condition import Condition
from launch.launch_description_entity import LaunchDescriptionEntity as LaunchDescriptionEntity
from launch.some_substitutions_type import SomeSubstitutionsType as SomeSubstitutionsType
from typing import Dict
from typing import Text
from .opaque_function import OpaqueFunction as OpaqueFunction
from .pop_environment import PopEnvironment as PopEnvironment
from .pop_launch_configurations import PopLaunchConfigurations as PopLaunchConfigurations
from .push_environment import PushEnvironment as PushEnvironment
from .push_launch_configurations import PushLaunchConfigurations as PushLaunchConfigurations
from .replace_environment_variables import (
    ReplaceEnvironmentVariables as ReplaceEnvironmentVariables,
)
from .reset_launch_configurations import ResetLaunchConfigurations as ResetLaunchConfigurations
from ..event_handler import EventHandler as EventHandler
from ..events import Shutdown as Shutdown
from ..events import TimerEvent as TimerEvent
from ..frontend import Entity as Entity
from ..frontend import expose_action as expose_action
from ..frontend import Parser as Parser
from ..launch_context import LaunchContext as LaunchContext
from ..some_entities_type import SomeEntitiesType as SomeEntitiesType
from ..some_substitutions_type import (
    SomeSubstitutionsType_types_tuple as SomeSubstitutionsType_types_tuple,
)
from ..utilities import ensure_argument_type as ensure_argument_type
from ..utilities import is_a_subclass as is_a_subclass
from ..utilities import type_utils as type_utils

class TimerAction(Action):
    def __init__(
        self,
        *,
        period: float | SomeSubstitutionsType,
        actions: Iterable[LaunchDescriptionEntity],
        cancel_on_shutdown: bool | SomeSubstitutionsType = True,
        condition: Condition | None = None,
    ) -> None: ...
    @property
    def period(self) -> Any: ...
    @property
    def actions(self) -> list[LaunchDescriptionEntity]: ...
    def handle(self, context: Any) -> Any: ...
    def cancel(self) -> None: ...
    __context_environment: Dict[Text, Text]
