# Made by scripts/make_stubs.py from ament_index_python 1.8.1 of ROS 2 Jazzy; do not edit.
from typing import List
from .constants import AMENT_PREFIX_PATH_ENV_VAR as AMENT_PREFIX_PATH_ENV_VAR

def get_search_paths() -> List[str]: ...
