from collections.abc import Awaitable, Callable, Coroutine
from typing import Any, Optional, Union
from typing_extensions import Self
from rclpy.task import Future as Future
from rclpy.task import Task as Task

async def await_or_execute(
    callback: Union[Callable[..., Any], Coroutine[Any, Any, Any]], *args: Any
) -> Any: ...

class TimeoutObject:
    @property
    def timeout(self) -> float: ...
    @timeout.setter
    def timeout(self, timeout: float) -> None: ...

class Executor:
    def create_task(
        self,
        callback: Union[Callable[..., Any], Coroutine[Any, Any, Any]],
        *args: Any,
        **kwargs: Any,
    ) -> Task[Any]: ...
    def spin_until_future_complete(
        self, future: Future[Any], timeout_sec: Optional[float] = None
    ) -> None: ...
    def spin_once_until_future_complete(
        self, future: Future[Any], timeout_sec: Optional[Union[float, TimeoutObject]] = None
    ) -> None: ...
    def can_execute(self, entity: Any) -> bool: ...
    def wait_for_ready_callbacks(self, *args: Any, **kwargs: Any) -> Any: ...
    def __enter__(self) -> Self: ...
    _tasks: Any

class SingleThreadedExecutor(Executor):
    def spin_once_until_future_complete(
        self, future: Future[Any], timeout_sec: Optional[Union[float, TimeoutObject]] = None
    ) -> None: ...

class MultiThreadedExecutor(Executor):
    def spin_once_until_future_complete(
        self, future: Future[Any], timeout_sec: Optional[Union[float, TimeoutObject]] = None
    ) -> None: ...
