from collections.abc import Awaitable, Callable, Iterable
from typing import Any
from launch.action import Action as Action
from launch.condition import Condition
from ..event import Event as Event
from ..event_handlers import OnShutdown as OnShutdown
from ..launch_context import LaunchContext as LaunchContext
from ..some_entities_type import SomeEntitiesType as SomeEntitiesType
from ..utilities import ensure_argument_type as ensure_argument_type

class OpaqueCoroutine(Action):
    def __init__(
        self,
        *,
        coroutine: Callable[..., Awaitable[None]],
        args: Iterable[Any] | None = None,
        kwargs: dict[str, Any] | None = None,
        ignore_context: bool = False,
        condition: Condition | None = None,
    ) -> None: ...
