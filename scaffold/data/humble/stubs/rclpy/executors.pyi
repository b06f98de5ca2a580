from typing import Any
from typing import Callable
from typing import Coroutine
from typing import List
from typing import Optional
from typing import Set
from typing import TypeVar
from typing import Union
from rclpy.client import Client as Client
from rclpy.clock import Clock as Clock
from rclpy.clock_type import ClockType as ClockType
from rclpy.context import Context as Context
from rclpy.exceptions import InvalidHandle as InvalidHandle
from rclpy.guard_condition import GuardCondition as GuardCondition
from rclpy.service import Service as Service
from rclpy.signals import SignalHandlerGuardCondition as SignalHandlerGuardCondition
from rclpy.subscription import Subscription as Subscription
from rclpy.task import Future as Future
from rclpy.task import Task as Task
from rclpy.timer import Timer as Timer
from rclpy.utilities import get_default_context as get_default_context
from rclpy.utilities import timeout_sec_to_nsec as timeout_sec_to_nsec
from rclpy.waitable import NumberOfEntities as NumberOfEntities
from rclpy.waitable import Waitable as Waitable
from rclpy.node import Node as Node
from rclpy.exceptions import TimerCancelledError as TimerCancelledError

WaitableEntityType = TypeVar("WaitableEntityType")

class _WorkTracker:
    def __init__(self) -> None: ...
    def __enter__(self) -> None: ...
    def __exit__(self, t: Any, v: Any, tb: Any) -> None: ...
    def wait(self, timeout_sec: Optional[float] = None) -> Any: ...
    _num_work_executing: Any
    _work_condition: Any

async def await_or_execute(
    callback: Union[Callable[..., Any], Coroutine[Any, Any, Any]], *args: Any
) -> Any: ...

class TimeoutException(Exception): ...
class ShutdownException(Exception): ...
class ExternalShutdownException(Exception): ...
class ConditionReachedException(Exception): ...

class TimeoutObject:
    def __init__(self, timeout: float) -> None: ...
    @property
    def timeout(self) -> float: ...
    @timeout.setter
    def timeout(self, timeout: float) -> None: ...
    _timeout: Any

class Executor:
    def __init__(self, *, context: Optional[Context] = None) -> None: ...
    @property
    def context(self) -> Context: ...
    def create_task(
        self,
        callback: Union[Callable[..., Any], Coroutine[Any, Any, Any]],
        *args: Any,
        **kwargs: Any,
    ) -> Task[Any]: ...
    def shutdown(self, timeout_sec: Optional[float] = None) -> bool: ...
    def add_node(self, node: Node) -> bool: ...
    def remove_node(self, node: Node) -> None: ...
    def wake(self) -> None: ...
    def get_nodes(self) -> List["Node"]: ...
    def spin(self) -> None: ...
    def spin_until_future_complete(
        self, future: Future[Any], timeout_sec: Optional[float] = None
    ) -> None: ...
    def spin_once(self, timeout_sec: Optional[float] = None) -> None: ...
    def spin_once_until_future_complete(
        self, future: Future[Any], timeout_sec: Optional[Union[float, TimeoutObject]] = None
    ) -> None: ...
    _take_timer: Any
    _take_subscription: Any
    _take_client: Any
    _take_service: Any
    _take_guard_condition: Any
    _make_handler: Any

    def can_execute(self, entity: Any) -> bool: ...
    _wait_for_ready_callbacks: Any

    def wait_for_ready_callbacks(self, *args: Any, **kwargs: Any) -> Any: ...
    _context: Any
    _nodes: Set[Node]
    _nodes_lock: Any
    _tasks: Any
    _tasks_lock: Any
    _guard: Any
    _is_shutdown: Any
    _work_tracker: Any
    _shutdown_lock: Any
    _cb_iter: Any
    _last_args: Any
    _last_kwargs: Any
    _clock: Any
    _sigint_gc: Any
    _execute_timer: Any
    _execute_subscription: Any
    _execute_client: Any
    _execute_service: Any
    _execute_guard_condition: Any
    _execute_waitable: Any

class SingleThreadedExecutor(Executor):
    def __init__(self, *, context: Optional[Context] = None) -> None: ...
    _spin_once_impl: Any

    def spin_once(self, timeout_sec: Optional[float] = None) -> None: ...
    def spin_once_until_future_complete(
        self, future: Future[Any], timeout_sec: Optional[Union[float, TimeoutObject]] = None
    ) -> None: ...

class MultiThreadedExecutor(Executor):
    def __init__(
        self, num_threads: Optional[int] = None, *, context: Optional[Context] = None
    ) -> None: ...
    _spin_once_impl: Any

    def spin_once(self, timeout_sec: Optional[float] = None) -> None: ...
    def spin_once_until_future_complete(
        self, future: Future[Any], timeout_sec: Optional[Union[float, TimeoutObject]] = None
    ) -> None: ...
    _futures: Any
    _executor: Any
