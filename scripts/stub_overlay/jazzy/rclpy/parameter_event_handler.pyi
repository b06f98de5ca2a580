from collections.abc import Callable
from typing import Any

class ParameterCallbackHandle:
    mutex: Any

class ParameterEventCallbackHandle:
    mutex: Any

class ParameterEventHandler:
    class Callbacks:
        mutex: Any

    def add_parameter_callback(
        self, parameter_name: str, node_name: str, callback: Callable[[Parameter], object]
    ) -> ParameterCallbackHandle: ...
    def add_parameter_event_callback(
        self, callback: Callable[[ParameterEvent], object]
    ) -> ParameterEventCallbackHandle: ...
