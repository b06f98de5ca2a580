from typing_extensions import Self
from typing import Any
from types import TracebackType
from typing import Callable
from typing import ContextManager
from typing import List
from typing import Optional
from typing import Type
import weakref
from rclpy.node import Node as Node

g_logging_configure_lock: Any
g_logging_ref_count: int

class Context(ContextManager["Context"]):
    def __init__(self) -> None: ...
    @property
    def handle(self) -> Optional[ContextHandle]: ...
    def destroy(self) -> None: ...
    def init(
        self,
        args: Optional[List[str]] = None,
        *,
        initialize_logging: bool = True,
        domain_id: Optional[int] = None,
    ) -> None: ...
    def ok(self) -> bool: ...
    _call_on_shutdown_callbacks: Any

    def shutdown(self) -> None: ...
    def try_shutdown(self) -> None: ...
    _remove_callback: Any

    def on_shutdown(self, callback: Callable[[], object]) -> None: ...
    _logging_fini: Any

    def get_domain_id(self) -> int: ...
    def __enter__(self) -> Self: ...
    def __exit__(
        self,
        exc_type: Optional[Type[BaseException]],
        exc_val: Optional[BaseException],
        exc_tb: Optional[TracebackType],
    ) -> None: ...
    _lock: Any
    _callbacks: Any
    _logging_initialized: Any
    __context: Optional[ContextHandle]

    def track_node(self, node: Node) -> None: ...
    def untrack_node(self, node: Node) -> None: ...
    _cleanup: Any
    __node_weak_ref_list: List[weakref.ReferenceType["Node"]]
