from typing_extensions import Self
from typing import Any
from typing import Callable
from typing import Dict
from typing import Iterator
from typing import List
from typing import Optional
from typing import Sequence
from typing import Tuple
from typing import Type
from typing import TypeVar
from typing import Union
from rcl_interfaces.msg import FloatingPointRange as FloatingPointRange
from rcl_interfaces.msg import IntegerRange as IntegerRange
from rcl_interfaces.msg import ListParametersResult as ListParametersResult
from rcl_interfaces.msg import ParameterDescriptor as ParameterDescriptor
from rcl_interfaces.msg import ParameterEvent as ParameterEvent
from rcl_interfaces.msg import ParameterType as ParameterType
from rcl_interfaces.msg import ParameterValue as ParameterValue
from rcl_interfaces.msg import SetParametersResult as SetParametersResult
from rcl_interfaces.srv import ListParameters as ListParameters
from rclpy.callback_groups import CallbackGroup as CallbackGroup
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup as MutuallyExclusiveCallbackGroup
from rclpy.callback_groups import ReentrantCallbackGroup as ReentrantCallbackGroup
from rclpy.client import Client as Client
from rclpy.clock import Clock as Clock
from rclpy.clock import ROSClock as ROSClock
from rclpy.constants import S_TO_NS as S_TO_NS
from rclpy.context import Context as Context
from rclpy.event_handler import PublisherEventCallbacks as PublisherEventCallbacks
from rclpy.event_handler import SubscriptionEventCallbacks as SubscriptionEventCallbacks
from rclpy.exceptions import InvalidHandle as InvalidHandle
from rclpy.exceptions import InvalidParameterTypeException as InvalidParameterTypeException
from rclpy.exceptions import InvalidParameterValueException as InvalidParameterValueException
from rclpy.exceptions import InvalidTopicNameException as InvalidTopicNameException
from rclpy.exceptions import NotInitializedException as NotInitializedException
from rclpy.exceptions import ParameterAlreadyDeclaredException as ParameterAlreadyDeclaredException
from rclpy.exceptions import ParameterImmutableException as ParameterImmutableException
from rclpy.exceptions import ParameterNotDeclaredException as ParameterNotDeclaredException
from rclpy.exceptions import ParameterUninitializedException as ParameterUninitializedException
from rclpy.executors import Executor as Executor
from rclpy.expand_topic_name import expand_topic_name as expand_topic_name
from rclpy.guard_condition import GuardCondition as GuardCondition
from rclpy.logging import get_logger as get_logger
from rclpy.logging_service import LoggingService as LoggingService
from rclpy.parameter import (
    Parameter as Parameter,
    PARAMETER_SEPARATOR_STRING as PARAMETER_SEPARATOR_STRING,
)
from rclpy.parameter_service import ParameterService as ParameterService
from rclpy.publisher import Publisher as Publisher
from rclpy.qos import qos_profile_parameter_events as qos_profile_parameter_events
from rclpy.qos import qos_profile_services_default as qos_profile_services_default
from rclpy.qos import QoSProfile as QoSProfile
from rclpy.qos_overriding_options import QoSOverridingOptions as QoSOverridingOptions
from rclpy.service import Service as Service
from rclpy.subscription import Subscription as Subscription
from rclpy.time_source import TimeSource as TimeSource
from rclpy.timer import Rate as Rate
from rclpy.timer import Timer as Timer
from rclpy.topic_endpoint_info import TopicEndpointInfo as TopicEndpointInfo
from rclpy.type_description_service import TypeDescriptionService as TypeDescriptionService
from rclpy.type_support import check_is_valid_msg_type as check_is_valid_msg_type
from rclpy.type_support import check_is_valid_srv_type as check_is_valid_srv_type
from rclpy.utilities import get_default_context as get_default_context
from rclpy.validate_full_topic_name import validate_full_topic_name as validate_full_topic_name
from rclpy.validate_namespace import validate_namespace as validate_namespace
from rclpy.validate_node_name import validate_node_name as validate_node_name
from rclpy.validate_parameter_name import validate_parameter_name as validate_parameter_name
from rclpy.validate_topic_name import validate_topic_name as validate_topic_name
from rclpy.waitable import Waitable as Waitable
from collections.abc import Awaitable
from typing import overload
from _ros_interfaces import AnyMessage, RequestT, ResponseT
from _ros_interfaces import Service as _ServiceType
from rclpy.impl.rcutils_logger import RcutilsLogger
from rclpy.parameter import AllowableParameterValue as AllowableParameterValue
from rclpy.subscription import MessageInfo
from types import TracebackType
from rclpy.parameter import AllowableParameterValueT as AllowableParameterValueT
from rclpy.qos import qos_profile_rosout_default as qos_profile_rosout_default
from rclpy.subscription_content_filter_options import ContentFilterOptions as ContentFilterOptions
from rclpy.timer import TimerInfo as TimerInfo
from rclpy.type_support import MsgT as MsgT
from rclpy.type_support import Srv as Srv
from rclpy.type_support import SrvRequestT as SrvRequestT
from rclpy.type_support import SrvResponseT as SrvResponseT
from typing_extensions import deprecated as deprecated
from typing_extensions import TypeAlias as TypeAlias

HIDDEN_NODE_PREFIX: str
MsgType = TypeVar("MsgType")
SrvType = TypeVar("SrvType")
SrvTypeRequest = TypeVar("SrvTypeRequest")
SrvTypeResponse = TypeVar("SrvTypeResponse")

class NodeNameNonExistentError(RuntimeError): ...

class Node:
    PARAM_REL_TOL: float

    def __init__(
        self,
        node_name: str,
        *,
        context: Optional[Context] = None,
        cli_args: Optional[List[str]] = None,
        namespace: Optional[str] = None,
        use_global_arguments: bool = True,
        enable_rosout: bool = True,
        rosout_qos_profile: Union[QoSProfile, int] = qos_profile_rosout_default,
        start_parameter_services: bool = True,
        parameter_overrides: Optional[List[Parameter]] = None,
        allow_undeclared_parameters: bool = False,
        automatically_declare_parameters_from_overrides: bool = False,
        enable_logger_service: bool = False,
    ) -> None: ...
    @property
    def publishers(self) -> Iterator[Publisher]: ...
    @property
    def subscriptions(self) -> Iterator[Subscription]: ...
    @property
    def clients(self) -> Iterator[Client]: ...
    @property
    def services(self) -> Iterator[Service]: ...
    @property
    def timers(self) -> Iterator[Timer]: ...
    @property
    def guards(self) -> Iterator[GuardCondition]: ...
    @property
    def waitables(self) -> Iterator[Waitable]: ...
    @property
    def executor(self) -> Optional[Executor]: ...
    @executor.setter
    def executor(self, new_executor: Optional[Executor]) -> None: ...
    _wake_executor: Any

    @property
    def context(self) -> Context: ...
    @property
    def default_callback_group(self) -> CallbackGroup: ...
    @property
    def handle(self) -> Any: ...
    @handle.setter
    def handle(self, value: None) -> None: ...
    def get_name(self) -> str: ...
    def get_namespace(self) -> str: ...
    def get_clock(self) -> Clock: ...
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
    _declare_parameter_common: Any

    def undeclare_parameter(self, name: str) -> None: ...
    def has_parameter(self, name: str) -> bool: ...
    def get_parameter_types(self, names: List[str]) -> List[Parameter.Type]: ...
    def get_parameter_type(self, name: str) -> Parameter.Type: ...
    def get_parameters(self, names: List[str]) -> List[Parameter]: ...
    def get_parameter(self, name: str) -> Parameter: ...
    @overload
    def get_parameter_or(
        self, name: str, alternative_value: Optional[Parameter] = None
    ) -> Parameter: ...
    @overload
    def get_parameter_or(self, name: str, alternative_value: object) -> Any: ...
    def get_parameters_by_prefix(self, prefix: str) -> Dict[str, Parameter]: ...
    def set_parameters(self, parameter_list: List[Parameter]) -> List[SetParametersResult]: ...
    def set_parameters_atomically(self, parameter_list: List[Parameter]) -> SetParametersResult: ...
    _set_parameters_atomically: Any
    _set_parameters_atomically_common: Any

    def list_parameters(self, prefixes: List[str], depth: int) -> ListParametersResult: ...
    _check_undeclared_parameters: Any
    _call_pre_set_parameters_callback: Any
    _call_post_set_parameters_callback: Any

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
    _apply_descriptors: Any
    _apply_descriptor: Any
    _apply_integer_range: Any
    _apply_floating_point_range: Any
    _apply_descriptor_and_set: Any

    def describe_parameter(self, name: str) -> ParameterDescriptor: ...
    def describe_parameters(self, names: List[str]) -> List[ParameterDescriptor]: ...
    def set_descriptor(
        self,
        name: str,
        descriptor: ParameterDescriptor,
        alternative_value: Optional[ParameterValue] = None,
    ) -> ParameterValue: ...
    _validate_topic_or_service_name: Any
    _validate_qos_or_depth_parameter: Any

    def add_waitable(self, waitable: Waitable) -> None: ...
    def remove_waitable(self, waitable: Waitable) -> None: ...
    def resolve_topic_name(self, topic: str, *, only_expand: bool = False) -> str: ...
    def resolve_service_name(self, service: str, *, only_expand: bool = False) -> str: ...
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
    def create_rate(self, frequency: float, clock: Optional[Clock] = None) -> Rate: ...
    def destroy_publisher(self, publisher: Optional[Publisher[Any]]) -> bool: ...
    def destroy_subscription(self, subscription: Optional[Subscription[Any]]) -> bool: ...
    def destroy_client(self, client: Optional[Client[Any, Any]]) -> bool: ...
    def destroy_service(self, service: Optional[Service[Any, Any]]) -> bool: ...
    def destroy_timer(self, timer: Optional[Timer]) -> bool: ...
    def destroy_guard_condition(self, guard: Optional[GuardCondition]) -> bool: ...
    def destroy_rate(self, rate: Rate) -> bool: ...
    def destroy_node(self) -> None: ...
    def get_publisher_names_and_types_by_node(
        self, node_name: str, node_namespace: str, no_demangle: bool = False
    ) -> List[Tuple[str, List[str]]]: ...
    def get_subscriber_names_and_types_by_node(
        self, node_name: str, node_namespace: str, no_demangle: bool = False
    ) -> List[Tuple[str, List[str]]]: ...
    def get_service_names_and_types_by_node(
        self, node_name: str, node_namespace: str
    ) -> List[Tuple[str, List[str]]]: ...
    def get_client_names_and_types_by_node(
        self, node_name: str, node_namespace: str
    ) -> List[Tuple[str, List[str]]]: ...
    def get_topic_names_and_types(
        self, no_demangle: bool = False
    ) -> List[Tuple[str, List[str]]]: ...
    def get_service_names_and_types(self) -> List[Tuple[str, List[str]]]: ...
    def get_node_names(self) -> List[str]: ...
    def get_fully_qualified_node_names(self) -> List[str]: ...
    def get_node_names_and_namespaces(self) -> List[Tuple[str, str]]: ...
    def get_node_names_and_namespaces_with_enclaves(self) -> List[Tuple[str, str, str]]: ...
    def get_fully_qualified_name(self) -> str: ...
    _count_publishers_or_subscribers: Any

    def count_publishers(self, topic_name: str) -> int: ...
    def count_subscribers(self, topic_name: str) -> int: ...
    _count_clients_or_servers: Any

    def count_clients(self, service_name: str) -> int: ...
    def count_services(self, service_name: str) -> int: ...
    _get_info_by_topic: Any

    def get_publishers_info_by_topic(
        self, topic_name: str, no_mangle: bool = False
    ) -> List[TopicEndpointInfo]: ...
    def get_subscriptions_info_by_topic(
        self, topic_name: str, no_mangle: bool = False
    ) -> List[TopicEndpointInfo]: ...
    def wait_for_node(self, fully_qualified_node_name: str, timeout: float) -> bool: ...
    _context: Any
    _parameters: dict[Any, Any]
    _publishers: List[Publisher]
    _subscriptions: List[Subscription]
    _clients: List[Client]
    _services: List[Service]
    _timers: List[Timer]
    _guards: List[GuardCondition]
    __waitables: List[Waitable]
    _default_callback_group: Any
    _pre_set_parameters_callbacks: List[Callable[[List[Parameter]], List[Parameter]]]
    _on_set_parameters_callbacks: List[Callable[[List[Parameter]], SetParametersResult]]
    _post_set_parameters_callbacks: List[Callable[[List[Parameter]], None]]
    _rate_group: Any
    _allow_undeclared_parameters: Any
    _parameter_overrides: Any
    _descriptors: Any
    __executor_weakref: Any
    _parameter_event_publisher: Any
    _clock: Any
    _time_source: Any
    _type_description_service: Any
    _logger: Any
    _parameter_service: Any
    _logger_service: Any
    __node: Any
    ParameterInput: TypeAlias = Union[AllowableParameterValue, Parameter.Type, ParameterValue]

    def __enter__(self) -> Self: ...
    def __exit__(
        self,
        exc_type: Optional[Type[BaseException]],
        exc_val: Optional[BaseException],
        exc_tb: Optional[TracebackType],
    ) -> None: ...

_MsgT = TypeVar("_MsgT", bound=AnyMessage)
