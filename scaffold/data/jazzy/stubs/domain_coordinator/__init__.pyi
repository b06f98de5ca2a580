from collections.abc import Callable
from contextlib import AbstractContextManager

def domain_id(selector: Callable[[], int] | None = None) -> AbstractContextManager[int]: ...
