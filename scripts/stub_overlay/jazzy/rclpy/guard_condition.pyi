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
    @property
    def handle(self) -> Any: ...
