from typing import Any
from typing import Callable, List, Optional, Sequence, Union
from rcl_interfaces.msg import Parameter as ParameterMsg
from rcl_interfaces.msg import ParameterEvent as ParameterEvent
from rcl_interfaces.srv import DescribeParameters as DescribeParameters
from rcl_interfaces.srv import GetParameters as GetParameters
from rcl_interfaces.srv import GetParameterTypes as GetParameterTypes
from rcl_interfaces.srv import ListParameters as ListParameters
from rcl_interfaces.srv import SetParameters as SetParameters
from rcl_interfaces.srv import SetParametersAtomically as SetParametersAtomically
from rclpy.callback_groups import CallbackGroup as CallbackGroup
from rclpy.event_handler import SubscriptionEventCallbacks as SubscriptionEventCallbacks
from rclpy.node import Node as Node
from rclpy.parameter import Parameter as Parameter
from rclpy.parameter import parameter_dict_from_yaml_file as parameter_dict_from_yaml_file
from rclpy.qos import qos_profile_parameter_events as qos_profile_parameter_events
from rclpy.qos import qos_profile_services_default as qos_profile_services_default
from rclpy.qos import QoSProfile as QoSProfile
from rclpy.qos_overriding_options import QoSOverridingOptions as QoSOverridingOptions
from rclpy.subscription import Subscription as Subscription
from rclpy.task import Future as Future
from rclpy.client import Client as Client
from rclpy.subscription import MessageInfo as MessageInfo

class AsyncParameterClient:
    def __init__(
        self,
        node: Node,
        remote_node_name: str,
        qos_profile: QoSProfile = qos_profile_services_default,
        callback_group: Optional[CallbackGroup] = None,
    ) -> None: ...
    def services_are_ready(self) -> bool: ...
    def wait_for_services(self, timeout_sec: Optional[float] = None) -> bool: ...
    def list_parameters(
        self,
        prefixes: Optional[List[str]] = None,
        depth: Optional[int] = None,
        callback: Optional[Callable[..., Any]] = None,
    ) -> Future: ...
    def get_parameters(
        self, names: List[str], callback: Optional[Callable[..., Any]] = None
    ) -> Future: ...
    def set_parameters(
        self,
        parameters: Sequence[Union[Parameter, ParameterMsg]],
        callback: Optional[Callable[..., Any]] = None,
    ) -> Future: ...
    def describe_parameters(
        self, names: List[str], callback: Optional[Callable[..., Any]] = None
    ) -> Future: ...
    def get_parameter_types(
        self, names: List[str], callback: Optional[Callable[..., Any]] = None
    ) -> Future: ...
    def set_parameters_atomically(
        self,
        parameters: Sequence[Union[Parameter, ParameterMsg]],
        callback: Optional[Callable[..., Any]] = None,
    ) -> Future: ...
    def delete_parameters(
        self, names: List[str], callback: Optional[Callable[..., Any]] = None
    ) -> Future: ...
    def load_parameter_file(
        self,
        parameter_file: str,
        use_wildcard: bool = False,
        callback: Optional[Callable[..., Any]] = None,
    ) -> Future: ...
    def load_parameter_file_atomically(
        self,
        parameter_file: str,
        use_wildcard: bool = False,
        callback: Optional[Callable[..., Any]] = None,
    ) -> Future: ...
    def on_parameter_event(
        self,
        callback: Callable[..., Any],
        qos_profile: QoSProfile = qos_profile_parameter_events,
        *,
        callback_group: Optional[CallbackGroup] = None,
        event_callbacks: Optional[SubscriptionEventCallbacks] = None,
        qos_overriding_options: Optional[QoSOverridingOptions] = None,
        raw: bool = False,
    ) -> Subscription: ...
    remote_node_name: str
    node: Node
    _get_parameter_client: Any
    _list_parameter_client: Any
    _set_parameter_client: Any
    _get_parameter_types_client: Any
    _describe_parameters_client: Any
    _set_parameters_atomically_client: Any
