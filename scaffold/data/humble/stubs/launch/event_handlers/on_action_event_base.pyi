from typing import Any
from _ros_launch import Reaction
from launch.event import Event
from launch.event_handler import BaseEventHandler
from ..launch_context import LaunchContext as LaunchContext
from ..launch_description_entity import LaunchDescriptionEntity as LaunchDescriptionEntity
from ..some_actions_type import SomeActionsType as SomeActionsType
from ..action import Action as Action

class OnActionEventBase(BaseEventHandler):
    def __init__(
        self,
        *,
        action_matcher: Any,
        on_event: Reaction[Event],
        target_event_cls: type[Event],
        target_action_cls: type[Any],
        handle_once: bool = False,
    ) -> None: ...
