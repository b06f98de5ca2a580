import asyncio
from collections.abc import Coroutine, Iterable
from typing import Any
from launch.event import Event
from launch.launch_context import LaunchContext
from launch.launch_description import LaunchDescription
from .event_handlers import OnIncludeLaunchDescription as OnIncludeLaunchDescription
from .event_handlers import OnShutdown as OnShutdown
from .events import IncludeLaunchDescription as IncludeLaunchDescription
from .events import Shutdown as Shutdown
from .launch_description_entity import LaunchDescriptionEntity as LaunchDescriptionEntity
from .some_actions_type import SomeActionsType as SomeActionsType
from .utilities import AsyncSafeSignalManager as AsyncSafeSignalManager
from .utilities import (
    visit_all_entities_and_collect_futures as visit_all_entities_and_collect_futures,
)

class LaunchService:
    def __init__(
        self,
        *,
        argv: Iterable[str] | None = None,
        noninteractive: bool = False,
        debug: bool = False,
    ) -> None: ...
    def emit_event(self, event: Event) -> None: ...
    def include_launch_description(self, launch_description: LaunchDescription) -> None: ...
    async def run_async(self, *, shutdown_when_idle: bool = True) -> int: ...
    def run(self, *, shutdown_when_idle: bool = True) -> int: ...
    def shutdown(self, force_sync: bool = False) -> Coroutine[Any, Any, Any] | None: ...
    @property
    def context(self) -> LaunchContext: ...
    @property
    def event_loop(self) -> asyncio.AbstractEventLoop | None: ...
    @property
    def task(self) -> Any: ...
