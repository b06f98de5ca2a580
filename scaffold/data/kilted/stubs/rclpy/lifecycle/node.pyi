from typing import NamedTuple
from typing import Optional
from typing import Set
from rclpy.callback_groups import CallbackGroup as CallbackGroup
from rclpy.node import Node as Node
from rclpy.qos import QoSProfile as QoSProfile
from rclpy.service import Service as Service
from rclpy.type_support import check_is_valid_srv_type as check_is_valid_srv_type
from .managed_entity import ManagedEntity as ManagedEntity
from .publisher import LifecyclePublisher as LifecyclePublisher
from typing import Any, List, TypeVar, Union
from _ros_interfaces import AnyMessage
from rclpy.context import Context
from rclpy.event_handler import PublisherEventCallbacks
from rclpy.lifecycle.managed_entity import TransitionCallbackReturn as TransitionCallbackReturn
from rclpy.parameter import Parameter
from rclpy.qos_overriding_options import QoSOverridingOptions
from typing import Literal
from typing import TypedDict
from rclpy.impl.rcutils_logger import RcutilsLogger as RcutilsLogger
from rclpy.type_support import MsgT as MsgT
from typing_extensions import TypeAlias as TypeAlias
from typing_extensions import Unpack as Unpack

class LifecycleState(NamedTuple):
    label: str
    state_id: int

class LifecycleNodeMixin(ManagedEntity):
    def __init__(
        self,
        *,
        enable_communication_interface: bool = True,
        callback_group: Optional[CallbackGroup] = None,
    ) -> None: ...
    def trigger_configure(self) -> TransitionCallbackReturn: ...
    def trigger_cleanup(self) -> TransitionCallbackReturn: ...
    def trigger_shutdown(self) -> TransitionCallbackReturn: ...
    def trigger_activate(self) -> TransitionCallbackReturn: ...
    def trigger_deactivate(self) -> TransitionCallbackReturn: ...
    def add_managed_entity(self, entity: ManagedEntity) -> None: ...
    __transition_callback_impl: Any

    def on_configure(self, state: LifecycleState) -> TransitionCallbackReturn: ...
    def on_cleanup(self, state: LifecycleState) -> TransitionCallbackReturn: ...
    def on_shutdown(self, state: LifecycleState) -> TransitionCallbackReturn: ...
    def on_activate(self, state: LifecycleState) -> TransitionCallbackReturn: ...
    def on_deactivate(self, state: LifecycleState) -> TransitionCallbackReturn: ...
    def on_error(self, state: LifecycleState) -> TransitionCallbackReturn: ...
    def create_lifecycle_publisher(
        self,
        msg_type: type[_MsgT],
        topic: str,
        qos_profile: Union[QoSProfile, int],
        *,
        publisher_class: None = None,
        **kwargs: Unpack[CreateLifecyclePublisherArgs],
    ) -> LifecyclePublisher[_MsgT]: ...
    def destroy_lifecycle_publisher(self, publisher: LifecyclePublisher[Any]) -> bool: ...
    __register_callback: Any
    __execute_callback: Any
    __change_state: Any
    __check_is_initialized: Any
    __on_change_state: Any
    __on_get_state: Any
    __on_get_available_states: Any
    __on_get_available_transitions: Any
    __on_get_transition_graph: Any
    _callbacks: Any
    _managed_entities: Set[ManagedEntity]
    _state_machine: Any
    _service_change_state: Any
    _service_get_state: Any
    _service_get_available_states: Any
    _service_get_available_transitions: Any
    _service_get_transition_graph: Any
    _logger: RcutilsLogger

class LifecycleNode(LifecycleNodeMixin, Node):
    def __init__(
        self,
        node_name: str,
        *,
        enable_communication_interface: bool = True,
        context: Optional[Context] = None,
        cli_args: Optional[List[str]] = None,
        namespace: Optional[str] = None,
        use_global_arguments: bool = True,
        enable_rosout: bool = True,
        start_parameter_services: bool = True,
        parameter_overrides: Optional[List[Parameter]] = None,
        allow_undeclared_parameters: bool = False,
        automatically_declare_parameters_from_overrides: bool = False,
        enable_logger_service: bool = False,
    ) -> None: ...

_MsgT = TypeVar("_MsgT", bound=AnyMessage)
CallbackNames = Literal[
    "on_configure", "on_cleanup", "on_shutdown", "on_activate", "on_deactivate", "on_error"
]

class CreateLifecyclePublisherArgs(TypedDict, total=False):
    callback_group: Optional[CallbackGroup]
    event_callbacks: Optional[PublisherEventCallbacks]
    qos_overriding_options: Optional[QoSOverridingOptions]

class LifecycleNodeArgs(TypedDict, total=False):
    context: Optional[Context]
    cli_args: Optional[List[str]]
    namespace: Optional[str]
    use_global_arguments: bool
    enable_rosout: bool
    start_parameter_services: bool
    parameter_overrides: Optional[List[Parameter[Any]]]
    allow_undeclared_parameters: bool
    automatically_declare_parameters_from_overrides: bool
    enable_logger_service: bool
