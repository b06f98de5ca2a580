from typing import Any

from launch.frontend.parser import (
    InvalidFrontendLaunchFileError as InvalidFrontendLaunchFileError,
)
from launch.launch_description import LaunchDescription

def get_launch_description_from_frontend_launch_file(
    frontend_launch_file_path: str, *, parser: Any = ...
) -> LaunchDescription: ...
