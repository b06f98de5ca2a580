from collections.abc import Callable
from typing import Any

def matches_node_name(node_name: str) -> Callable[[Any], bool]: ...
