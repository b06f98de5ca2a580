from typing_extensions import Self
from typing import List
from typing import Optional
from rclpy.context import Context as Context
from rclpy.parameter import Parameter as Parameter
from rclpy.signals import install_signal_handlers as install_signal_handlers
from rclpy.signals import SignalHandlerOptions as SignalHandlerOptions
from rclpy.signals import uninstall_signal_handlers as uninstall_signal_handlers
from rclpy.task import Future as Future
from rclpy.utilities import get_default_context as get_default_context
from rclpy.utilities import get_rmw_implementation_identifier as get_rmw_implementation_identifier
from rclpy.utilities import ok as ok
from rclpy.executors import Executor as Executor
from rclpy.node import Node as Node
from rclpy import (
    callback_groups as callback_groups,
    client as client,
    clock as clock,
    clock_type as clock_type,
    constants as constants,
    context as context,
    duration as duration,
    event_handler as event_handler,
    exceptions as exceptions,
    executors as executors,
    expand_topic_name as expand_topic_name,
    guard_condition as guard_condition,
    impl as impl,
    lifecycle as lifecycle,
    logging as logging,
    logging_service as logging_service,
    node as node,
    parameter as parameter,
    parameter_service as parameter_service,
    publisher as publisher,
    qos as qos,
    qos_overriding_options as qos_overriding_options,
    service as service,
    service_introspection as service_introspection,
    signals as signals,
    subscription as subscription,
    task as task,
    time as time,
    time_source as time_source,
    timer as timer,
    topic_endpoint_info as topic_endpoint_info,
    type_description_service as type_description_service,
    type_hash as type_hash,
    type_support as type_support,
    utilities as utilities,
    validate_full_topic_name as validate_full_topic_name,
    validate_namespace as validate_namespace,
    validate_node_name as validate_node_name,
    validate_parameter_name as validate_parameter_name,
    validate_topic_name as validate_topic_name,
    waitable as waitable,
)
from typing import Any
from types import TracebackType
from typing import Type
from typing import Union
from rclpy.qos import qos_profile_rosout_default as qos_profile_rosout_default
from rclpy.qos import QoSProfile as QoSProfile

def init(
    *,
    args: Optional[List[str]] = None,
    context: Optional[Context] = None,
    domain_id: Optional[int] = None,
    signal_handler_options: Optional[SignalHandlerOptions] = None,
) -> InitContextManager: ...
def get_global_executor() -> Executor: ...
def shutdown(
    *, context: Optional[Context] = None, uninstall_handlers: Optional[bool] = None
) -> None: ...
def create_node(
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
) -> Node: ...
def spin_once(
    node: Node, *, executor: Optional[Executor] = None, timeout_sec: Optional[float] = None
) -> None: ...
def spin(node: Node, executor: Optional[Executor] = None) -> None: ...
def spin_until_future_complete(
    node: Node,
    future: Future[Any],
    executor: Optional[Executor] = None,
    timeout_sec: Optional[float] = None,
) -> None: ...

class InitContextManager:
    def __init__(
        self,
        args: Optional[List[str]],
        context: Optional[Context],
        domain_id: Optional[int],
        signal_handler_options: Optional[SignalHandlerOptions],
    ) -> None: ...
    def __enter__(self) -> Self: ...
    def __exit__(
        self,
        exc_type: Optional[Type[BaseException]],
        exc_val: Optional[BaseException],
        exc_tb: Optional[TracebackType],
    ) -> None: ...
    context: Any
    installed_signal_handlers: bool

def try_shutdown(
    *, context: Optional[Context] = None, uninstall_handlers: Optional[bool] = None
) -> None: ...
