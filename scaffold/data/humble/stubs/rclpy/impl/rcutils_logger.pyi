from collections import namedtuple
from collections import OrderedDict
from rclpy.clock import Clock as Clock
from rclpy.impl.logging_severity import LoggingSeverity as LoggingSeverity
from typing import Any

_internal_callers: Any
_populate_internal_callers: bool

class CallerId(namedtuple("CallerId", ["function_name", "file_path", "line_number", "last_index"])):
    def __new__(cls, frame: Any = None) -> Any: ...

class LoggingFilter:
    params: Any

    @classmethod
    def initialize_context(cls, context: Any, **kwargs: Any) -> None: ...
    @staticmethod
    def should_log(context: Any) -> Any: ...

class Once(LoggingFilter):
    params: Any

    @classmethod
    def initialize_context(cls, context: Any, **kwargs: Any) -> None: ...
    @staticmethod
    def should_log(context: Any) -> Any: ...

class Throttle(LoggingFilter):
    params: Any

    @classmethod
    def initialize_context(cls, context: Any, **kwargs: Any) -> None: ...
    @staticmethod
    def should_log(context: Any) -> Any: ...

class SkipFirst(LoggingFilter):
    params: Any

    @classmethod
    def initialize_context(cls, context: Any, **kwargs: Any) -> None: ...
    @staticmethod
    def should_log(context: Any) -> Any: ...

supported_filters: OrderedDict[Any, Any]

def get_filters_from_kwargs(**kwargs: Any) -> Any: ...

class RcutilsLogger:
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
    name: str
    contexts: Any
