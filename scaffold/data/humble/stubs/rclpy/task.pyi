from enum import Enum
from typing import Callable
from collections.abc import Generator
from typing import Any, Generic, Optional
from typing_extensions import TypeVar

class FutureState(Enum):
    PENDING = "PENDING"
    CANCELLED = "CANCELLED"
    FINISHED = "FINISHED"

class Future(Generic[T_co]):
    def __init__(self, *, executor: Any = None) -> None: ...
    def __await__(self) -> Generator[None, None, T_co]: ...
    _pending: Any

    def cancel(self) -> None: ...
    def cancelled(self) -> bool: ...
    def done(self) -> bool: ...
    def result(self) -> T_co: ...
    def exception(self) -> Optional[BaseException]: ...
    def set_result(self, result: Any) -> None: ...
    def set_exception(self, exception: BaseException) -> None: ...
    _schedule_or_invoke_done_callbacks: Any
    _set_executor: Any

    def add_done_callback(self, callback: Callable[[Future[T_co]], object]) -> None: ...
    _state: Any
    _result: Any
    _exception: Any
    _exception_fetched: Any
    _callbacks: Any
    _lock: Any
    _executor: Any

class Task(Future[T_co]):
    def __init__(
        self,
        handler: Any,
        args: Any = None,
        kwargs: Optional[dict[str, Any]] = None,
        executor: Any = None,
    ) -> None: ...
    def __call__(self) -> None: ...
    _complete_task: Any

    def executing(self) -> bool: ...
    def cancel(self) -> None: ...
    _handler: Any
    _args: Any
    _kwargs: Any
    _executing: Any
    _task_lock: Any

T_co = TypeVar("T_co", covariant=True, default=Any)
