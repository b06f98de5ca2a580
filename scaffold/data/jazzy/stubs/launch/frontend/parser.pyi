from typing import Any

from launch.invalid_launch_file_error import InvalidLaunchFileError

class InvalidFrontendLaunchFileError(InvalidLaunchFileError): ...

class Parser:
    extensions_loaded: bool
    frontend_parsers: Any
    @classmethod
    def load(cls, file: Any) -> tuple[Any, Any]: ...
    def __getattr__(self, name: str) -> Any: ...
