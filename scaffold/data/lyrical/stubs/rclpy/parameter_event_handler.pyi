from typing import Callable, Dict, Iterable, List, Optional, Tuple
from rcl_interfaces.msg import ParameterEvent as ParameterEvent
from rclpy.callback_groups import CallbackGroup as CallbackGroup
from rclpy.event_handler import SubscriptionEventCallbacks as SubscriptionEventCallbacks
from rclpy.node import Node as Node
from rclpy.qos import qos_profile_parameter_events as qos_profile_parameter_events
from rclpy.qos import QoSProfile as QoSProfile
from rclpy.qos_overriding_options import QoSOverridingOptions as QoSOverridingOptions
from typing import Any
from rcl_interfaces.msg import Parameter as ParameterMsg

class ParameterCallbackHandle:
    def __init__(
        self, parameter_name: str, node_name: str, callback: Callable[[Parameter], None]
    ) -> None: ...
    parameter_name: str
    node_name: str
    callback: Callable[[Parameter], None]
    mutex: Any

class ParameterEventCallbackHandle:
    def __init__(self, callback: Callable[[ParameterEvent], None]) -> None: ...
    callback: Callable[[ParameterEvent], None]
    mutex: Any

class ParameterEventHandler:
    class Callbacks:
        def __init__(self) -> None: ...
        def event_callback(self, event: ParameterEvent) -> None: ...
        def add_parameter_callback(
            self, parameter_name: str, node_name: str, callback: Callable[[Parameter], None]
        ) -> ParameterCallbackHandle: ...
        def remove_parameter_callback(self, handle: ParameterCallbackHandle) -> None: ...
        def add_parameter_event_callback(
            self, callback: Callable[[ParameterEvent], None]
        ) -> ParameterEventCallbackHandle: ...
        def remove_parameter_event_callback(self, handle: ParameterEventCallbackHandle) -> None: ...
        parameter_callbacks: Dict[Tuple[str, str], List[ParameterCallbackHandle]]
        event_callbacks: List[ParameterEventCallbackHandle]
        mutex: Any

    def __init__(
        self,
        node: Node,
        qos_profile: QoSProfile = qos_profile_parameter_events,
        callback_group: Optional[CallbackGroup] = None,
        event_callbacks: Optional[SubscriptionEventCallbacks] = None,
        qos_overriding_options: Optional[QoSOverridingOptions] = None,
        raw: bool = False,
    ) -> None: ...
    def destroy(self) -> None: ...
    @staticmethod
    def get_parameter_from_event(
        event: ParameterEvent, parameter_name: str, node_name: str
    ) -> Optional[Parameter]: ...
    @staticmethod
    def get_parameters_from_event(event: ParameterEvent) -> Iterable[Parameter]: ...
    def add_parameter_callback(
        self, parameter_name: str, node_name: str, callback: Callable[[Parameter], object]
    ) -> ParameterCallbackHandle: ...
    def remove_parameter_callback(self, handle: ParameterCallbackHandle) -> None: ...
    def add_parameter_event_callback(
        self, callback: Callable[[ParameterEvent], object]
    ) -> ParameterEventCallbackHandle: ...
    def remove_parameter_event_callback(self, handle: ParameterEventCallbackHandle) -> None: ...
    _resolve_path: Any
    node: Node
    qos_profile: QoSProfile
    _callbacks: Any
    parameter_event_subscription: Any

    def configure_nodes_filter(self, node_names: Optional[List[str]] = None) -> bool: ...
