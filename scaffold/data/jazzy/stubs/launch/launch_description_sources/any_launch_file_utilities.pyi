from typing import Any

from launch.launch_description import LaunchDescription

def get_launch_description_from_any_launch_file(
    launch_file_path: str, *, parser: Any = ...
) -> LaunchDescription: ...
