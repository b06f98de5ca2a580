from typing import Any

from launch.invalid_launch_file_error import InvalidLaunchFileError

class InvalidFrontendLaunchFileError(InvalidLaunchFileError): ...

def __getattr__(name: str) -> Any: ...
