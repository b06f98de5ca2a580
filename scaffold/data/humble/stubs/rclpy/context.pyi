from typing import Any
from typing import Callable
from typing import List
from typing import Optional

g_logging_configure_lock: Any
g_logging_ref_count: int

class Context:
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
    _lock: Any
    _callbacks: Any
    _logging_initialized: Any
    __context: Optional[ContextHandle]
