from collections.abc import Awaitable, Callable, Iterable
from typing import Any

from launch.action import Action as Action
from launch.condition import Condition

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
