from rclpy.utilities import get_default_context as get_default_context
from collections.abc import Callable
from typing import Any, Optional
from rclpy.callback_groups import CallbackGroup
from rclpy.context import Context

class GuardCondition:
    def __init__(
        self,
        callback: Optional[Callable[[], object]],
        callback_group: Optional[CallbackGroup],
        context: Optional[Context] = None,
    ) -> None: ...
    def trigger(self) -> None: ...
    @property
    def handle(self) -> Any: ...
    def destroy(self) -> None: ...
    _context: Any
    callback: Any
    callback_group: Any
    _executor_event: Any
    _executor_triggered: Any
    __gc: Any
