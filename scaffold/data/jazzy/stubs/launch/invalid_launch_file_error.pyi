from typing import Any

class InvalidLaunchFileError(Exception):
    def __init__(self, extension: str = "", *, likely_errors: Any = None) -> None: ...
