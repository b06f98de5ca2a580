from collections.abc import Awaitable, Callable, Sequence
from typing import Any, Dict, List, Optional, Tuple, Type, TypeVar, Union, overload
from _ros_interfaces import AnyMessage, RequestT, ResponseT
from _ros_interfaces import Service as _ServiceType
from rcl_interfaces.msg import ParameterDescriptor as ParameterDescriptor
from rcl_interfaces.msg import ParameterValue as ParameterValue
from rcl_interfaces.msg import SetParametersResult as SetParametersResult
from rclpy.callback_groups import CallbackGroup as CallbackGroup
from rclpy.client import Client as Client
from rclpy.clock import Clock as Clock
from rclpy.event_handler import PublisherEventCallbacks as PublisherEventCallbacks
from rclpy.event_handler import SubscriptionEventCallbacks as SubscriptionEventCallbacks
from rclpy.executors import Executor as Executor
from rclpy.guard_condition import GuardCondition as GuardCondition
from rclpy.impl.rcutils_logger import RcutilsLogger
from rclpy.parameter import AllowableParameterValue as AllowableParameterValue
from rclpy.parameter import Parameter as Parameter
from rclpy.publisher import Publisher as Publisher
from rclpy.qos import QoSProfile as QoSProfile
from rclpy.qos_overriding_options import QoSOverridingOptions as QoSOverridingOptions
from rclpy.service import Service as Service
from rclpy.subscription import MessageInfo, Subscription as Subscription
from rclpy.timer import Rate as Rate, Timer as Timer

_MsgT = TypeVar("_MsgT", bound=AnyMessage)

class NodeNameNonExistentError(RuntimeError): ...

class Node:
    PARAM_REL_TOL: float
    @property
    def handle(self) -> Any: ...
    @handle.setter
    def handle(self, value: Any) -> None: ...
    @property
    def executor(self) -> Optional[Executor]: ...
    @executor.setter
    def executor(self, new_executor: Optional[Executor]) -> None: ...
    def get_logger(self) -> RcutilsLogger: ...
    def declare_parameter(
        self,
        name: str,
        value: Union[AllowableParameterValue, Parameter.Type, ParameterValue] = None,
        descriptor: Optional[ParameterDescriptor] = None,
        ignore_override: bool = False,
    ) -> Parameter: ...
    def declare_parameters(
        self,
        namespace: str,
        parameters: Sequence[
            Union[Tuple[str], Tuple[str, Any], Tuple[str, Any, ParameterDescriptor]]
        ],
        ignore_override: bool = False,
    ) -> List[Parameter]: ...
    @overload
    def get_parameter_or(
        self, name: str, alternative_value: Optional[Parameter] = None
    ) -> Parameter: ...
    @overload
    def get_parameter_or(self, name: str, alternative_value: object) -> Any: ...
    def get_parameters_by_prefix(self, prefix: str) -> Dict[str, Parameter]: ...
    def add_pre_set_parameters_callback(
        self, callback: Callable[[List[Parameter]], List[Parameter]]
    ) -> None: ...
    def add_on_set_parameters_callback(
        self, callback: Callable[[List[Parameter]], SetParametersResult]
    ) -> None: ...
    def add_post_set_parameters_callback(
        self, callback: Callable[[List[Parameter]], object]
    ) -> None: ...
    def remove_pre_set_parameters_callback(self, callback: Callable[..., Any]) -> None: ...
    def remove_on_set_parameters_callback(self, callback: Callable[..., Any]) -> None: ...
    def remove_post_set_parameters_callback(self, callback: Callable[..., Any]) -> None: ...
    def create_publisher(
        self,
        msg_type: type[_MsgT],
        topic: str,
        qos_profile: Union[QoSProfile, int],
        *,
        callback_group: Optional[CallbackGroup] = None,
        event_callbacks: Optional[PublisherEventCallbacks] = None,
        qos_overriding_options: Optional[QoSOverridingOptions] = None,
        publisher_class: Type[Publisher[Any]] = ...,
    ) -> Publisher[_MsgT]: ...
    def create_subscription(
        self,
        msg_type: type[_MsgT],
        topic: str,
        callback: Union[
            Callable[[_MsgT], object],
            Callable[[_MsgT, MessageInfo], object],
            Callable[[bytes], object],
        ],
        qos_profile: Union[QoSProfile, int],
        *,
        callback_group: Optional[CallbackGroup] = None,
        event_callbacks: Optional[SubscriptionEventCallbacks] = None,
        qos_overriding_options: Optional[QoSOverridingOptions] = None,
        raw: bool = False,
    ) -> Subscription[_MsgT]: ...
    def create_client(
        self,
        srv_type: type[_ServiceType[RequestT, ResponseT]],
        srv_name: str,
        *,
        qos_profile: QoSProfile = ...,
        callback_group: Optional[CallbackGroup] = None,
    ) -> Client[RequestT, ResponseT]: ...
    def create_service(
        self,
        srv_type: type[_ServiceType[RequestT, ResponseT]],
        srv_name: str,
        callback: Callable[[RequestT, ResponseT], Union[ResponseT, Awaitable[ResponseT]]],
        *,
        qos_profile: QoSProfile = ...,
        callback_group: Optional[CallbackGroup] = None,
    ) -> Service[RequestT, ResponseT]: ...
    def create_timer(
        self,
        timer_period_sec: float,
        callback: Callable[[], object],
        callback_group: Optional[CallbackGroup] = None,
        clock: Optional[Clock] = None,
        autostart: bool = True,
    ) -> Timer: ...
    def create_guard_condition(
        self, callback: Callable[[], object], callback_group: Optional[CallbackGroup] = None
    ) -> GuardCondition: ...
    def destroy_publisher(self, publisher: Optional[Publisher[Any]]) -> bool: ...
    def destroy_subscription(self, subscription: Optional[Subscription[Any]]) -> bool: ...
    def destroy_client(self, client: Optional[Client[Any, Any]]) -> bool: ...
    def destroy_service(self, service: Optional[Service[Any, Any]]) -> bool: ...
    # None is none of the node's: they return False.
    def destroy_timer(self, timer: Optional[Timer]) -> bool: ...
    def destroy_guard_condition(self, guard: Optional[GuardCondition]) -> bool: ...
