from collections.abc import Callable
from contextlib import AbstractContextManager

PORT_BASE: int

class default_selector:
    def __call__(self) -> int: ...

def domain_id(selector: Callable[[], int] | None = None) -> AbstractContextManager[int]: ...
