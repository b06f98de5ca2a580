from collections import OrderedDict
from rclpy.clock import Clock as Clock
from rclpy.impl.logging_severity import LoggingSeverity as LoggingSeverity
from typing import Any
from typing import List
from typing import Literal
from typing import Optional
from typing import TypedDict
from typing_extensions import Unpack as Unpack
from typing_extensions import deprecated as deprecated

_internal_callers: Any
_populate_internal_callers: bool

class CallerId(
    NamedTuple(
        "CallerId",
        [("function_name", str), ("file_path", str), ("line_number", int), ("last_index", int)],
    )
):
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
        self, message: str, severity: int, name: str = None, **kwargs: Unpack[LoggingFilterArgs]
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
    logger_sublogger_namepair: Any
    contexts: Any

SupportedFiltersKeys = Literal["throttle", "skip_first", "once"]

class RcutilsLoggerContext(TypedDict):
    name: str
    severity: LoggingSeverity
    filters: List[SupportedFiltersKeys]

class OnceContext(RcutilsLoggerContext):
    has_been_logged_once: bool

class ThrottleContext(RcutilsLoggerContext):
    throttle_duration_sec: float
    throttle_time_source_type: Clock
    throttle_last_logged: int

class SkipFirstContext(RcutilsLoggerContext):
    first_has_been_skipped: bool

class LoggingFilterArgs(TypedDict, total=False):
    once: bool
    throttle_duration_sec: float
    throttle_time_source_type: Clock
    skip_first: bool

class LoggingFilterParams(TypedDict, total=False):
    once: Optional[bool]
    throttle_duration_sec: Optional[float]
    throttle_time_source_type: Clock
    skip_first: Optional[bool]

class LoggingArgs(LoggingFilterArgs, total=False):
    name: str
