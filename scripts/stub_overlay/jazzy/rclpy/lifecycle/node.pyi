from typing import Any, List, Optional, TypeVar, Union
from _ros_interfaces import AnyMessage
from rclpy.callback_groups import CallbackGroup as CallbackGroup
from rclpy.context import Context
from rclpy.event_handler import PublisherEventCallbacks
from rclpy.lifecycle.managed_entity import TransitionCallbackReturn as TransitionCallbackReturn
from rclpy.lifecycle.publisher import LifecyclePublisher as LifecyclePublisher
from rclpy.parameter import Parameter
from rclpy.qos import QoSProfile as QoSProfile
from rclpy.qos_overriding_options import QoSOverridingOptions

_MsgT = TypeVar("_MsgT", bound=AnyMessage)

class LifecycleNodeMixin(ManagedEntity):
    def trigger_configure(self) -> TransitionCallbackReturn: ...
    def trigger_cleanup(self) -> TransitionCallbackReturn: ...
    def trigger_shutdown(self) -> TransitionCallbackReturn: ...
    def trigger_activate(self) -> TransitionCallbackReturn: ...
    def trigger_deactivate(self) -> TransitionCallbackReturn: ...
    def create_lifecycle_publisher(
        self,
        msg_type: type[_MsgT],
        topic: str,
        qos_profile: Union[QoSProfile, int],
        *,
        callback_group: Optional[CallbackGroup] = None,
        event_callbacks: Optional[PublisherEventCallbacks] = None,
        qos_overriding_options: Optional[QoSOverridingOptions] = None,
    ) -> LifecyclePublisher[_MsgT]: ...
    def destroy_lifecycle_publisher(self, publisher: LifecyclePublisher[Any]) -> bool: ...
    _callbacks: Any

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

del TransitionCallbackReturn
