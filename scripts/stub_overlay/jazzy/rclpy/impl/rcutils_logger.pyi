from typing import Any, Optional
from rclpy.impl.logging_severity import LoggingSeverity as LoggingSeverity

class RcutilsLogger:
    name: str
    def __init__(self, name: str = "") -> None: ...
    def get_child(self, name: str) -> RcutilsLogger: ...
    def set_level(self, level: int) -> None: ...
    def get_effective_level(self) -> LoggingSeverity: ...
    def is_enabled_for(self, severity: int) -> bool: ...
    def log(
        self,
        message: str,
        severity: int,
        *,
        name: str = ...,
        throttle_duration_sec: float = ...,
        throttle_time_source_type: Any = ...,
        skip_first: bool = ...,
        once: bool = ...,
    ) -> bool: ...
    def debug(
        self,
        message: str,
        *,
        name: str = ...,
        throttle_duration_sec: float = ...,
        throttle_time_source_type: Any = ...,
        skip_first: bool = ...,
        once: bool = ...,
    ) -> bool: ...
    def info(
        self,
        message: str,
        *,
        name: str = ...,
        throttle_duration_sec: float = ...,
        throttle_time_source_type: Any = ...,
        skip_first: bool = ...,
        once: bool = ...,
    ) -> bool: ...
    def warning(
        self,
        message: str,
        *,
        name: str = ...,
        throttle_duration_sec: float = ...,
        throttle_time_source_type: Any = ...,
        skip_first: bool = ...,
        once: bool = ...,
    ) -> bool: ...
    def warn(
        self,
        message: str,
        *,
        name: str = ...,
        throttle_duration_sec: float = ...,
        throttle_time_source_type: Any = ...,
        skip_first: bool = ...,
        once: bool = ...,
    ) -> bool: ...
    def error(
        self,
        message: str,
        *,
        name: str = ...,
        throttle_duration_sec: float = ...,
        throttle_time_source_type: Any = ...,
        skip_first: bool = ...,
        once: bool = ...,
    ) -> bool: ...
    def fatal(
        self,
        message: str,
        *,
        name: str = ...,
        throttle_duration_sec: float = ...,
        throttle_time_source_type: Any = ...,
        skip_first: bool = ...,
        once: bool = ...,
    ) -> bool: ...
