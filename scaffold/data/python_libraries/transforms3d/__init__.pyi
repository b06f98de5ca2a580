# What is certain of transforms3d. All other names may be anything.
from typing import Any

from . import euler as euler

def __getattr__(name: str) -> Any: ...
