from collections.abc import Iterable
from launch.actions.timer_action import TimerAction
from launch.launch_description_entity import LaunchDescriptionEntity
from launch.some_substitutions_type import SomeSubstitutionsType as SomeSubstitutionsType
from typing import Any
import asyncio
from typing import Optional
from typing import Text
from typing import Union
from launch.events import TimerEvent as TimerEvent
from launch.frontend import Entity as Entity
from launch.frontend import expose_action as expose_action
from launch.frontend import Parser as Parser
from launch.launch_context import LaunchContext as LaunchContext
from launch.some_substitutions_type import (
    SomeSubstitutionsType_types_tuple as SomeSubstitutionsType_types_tuple,
)
from launch.utilities import create_future as create_future
from launch.utilities import ensure_argument_type as ensure_argument_type
from launch.utilities import type_utils as type_utils
from launch_ros.ros_adapters import get_ros_node as get_ros_node

class RosTimer(TimerAction):
    def __init__(
        self,
        *,
        period: Union[float, SomeSubstitutionsType],
        actions: Iterable[LaunchDescriptionEntity],
        **kwargs: Any,
    ) -> None: ...
    __timer_callback: Any
    _wait_to_fire_event: Any

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> Any: ...
    def describe(self) -> Text: ...
    def execute(self, context: LaunchContext) -> Any: ...
    __period: Any
    __timer_future: Optional[asyncio.Future]
