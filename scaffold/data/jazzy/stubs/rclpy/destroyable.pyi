# Made by scripts/make_stubs.py from rclpy 7.1.6 of ROS 2 Jazzy; do not edit.
from types import TracebackType
from typing import Optional, Protocol, Type

class DestroyableType(Protocol):
    def __enter__(self) -> None: ...
    def __exit__(
        self,
        exc_type: Optional[Type[BaseException]],
        exc_val: Optional[BaseException],
        exctb: Optional[TracebackType],
    ) -> None: ...
    def destroy_when_not_in_use(self) -> None: ...
