from ament_index_python.packages import get_package_share_directory as get_package_share_directory
from typing import Any

def __getattr__(name: str) -> Any: ...
