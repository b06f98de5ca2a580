from collections.abc import Callable
from typing import Any

from launch.event import Event as Event
from launch.launch_context import LaunchContext
from launch.launch_description_entity import LaunchDescriptionEntity
from launch.some_entities_type import SomeEntitiesType as SomeEntitiesType

class BaseEventHandler:
    def __init__(self, *, matcher: Callable[[Event], bool], handle_once: bool = False) -> None: ...
    @property
    def handle_once(self) -> bool: ...
    @property
    def handler_description(self) -> Any: ...
    @property
    def matcher_description(self) -> Any: ...
    def matches(self, event: Event) -> bool: ...
    def describe(self) -> tuple[str, list[LaunchDescriptionEntity]]: ...
    def handle(self, event: Event, context: LaunchContext) -> SomeEntitiesType | None: ...

class EventHandler(BaseEventHandler):
    def __init__(
        self,
        *,
        matcher: Callable[[Event], bool],
        entities: SomeEntitiesType | None = None,
        handle_once: bool = False,
    ) -> None: ...
    @property
    def entities(self) -> Any: ...
