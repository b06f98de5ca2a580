import asyncio
from types import TracebackType
from typing import Any, Literal, Optional, overload, Type, Union
from rclpy.clock_type import ClockType as ClockType
from rclpy.context import Context as Context
from rclpy.node import BaseNode as BaseNode
from rclpy.parameter import Parameter as Parameter
from rclpy.qos import qos_profile_rosout_default as qos_profile_rosout_default
from rclpy.qos import qos_profile_services_default as qos_profile_services_default
from rclpy.qos import QoSProfile as QoSProfile
from rclpy.service import ServiceCallbackUnion as ServiceCallbackUnion
from rclpy.subscription import (
    GenericSubscriptionCallbackUnion as GenericSubscriptionCallbackUnion,
    SubscriptionCallbackUnion as SubscriptionCallbackUnion,
)
from rclpy.subscription_content_filter_options import ContentFilterOptions as ContentFilterOptions
from rclpy.timer import TimerCallbackUnion as TimerCallbackUnion
from rclpy.type_support import (
    MsgT as MsgT,
    Srv as Srv,
    SrvRequestT as SrvRequestT,
    SrvResponseT as SrvResponseT,
)
from .async_client import AsyncClient as AsyncClient
from .async_clock import AsyncClock as AsyncClock
from .async_publisher import AsyncPublisher as AsyncPublisher
from .async_service import AsyncService as AsyncService
from .async_subscription import AsyncSubscription as AsyncSubscription
from .async_timer import AsyncTimer as AsyncTimer

AsyncEntity = Union[AsyncPublisher, AsyncSubscription, AsyncService, AsyncClient, AsyncTimer]

class AsyncNode(BaseNode):
    def __init__(
        self,
        node_name: str,
        *,
        context: Optional[Context] = None,
        cli_args: Optional[list[str]] = None,
        namespace: Optional[str] = None,
        use_global_arguments: bool = True,
        enable_rosout: bool = True,
        rosout_qos_profile: Union[QoSProfile, int] = qos_profile_rosout_default,
        start_parameter_services: bool = True,
        parameter_overrides: Optional[list[Parameter[Any]]] = None,
        allow_undeclared_parameters: bool = False,
        automatically_declare_parameters_from_overrides: bool = False,
        enable_logger_service: bool = False,
    ) -> None: ...
    async def __aenter__(self) -> AsyncNode: ...
    async def __aexit__(
        self,
        exc_type: Optional[Type[BaseException]],
        exc_val: Optional[BaseException],
        exc_tb: Optional[TracebackType],
    ) -> None: ...
    def get_clock(self) -> AsyncClock: ...
    def destroy_node(self) -> None: ...
    async def wait_for_node(
        self, fully_qualified_node_name: str, *, check_interval: float = 0.1
    ) -> None: ...
    async def run(self) -> None: ...
    def create_publisher(
        self, msg_type: Type[MsgT], topic: str, qos_profile: Union[QoSProfile, int]
    ) -> AsyncPublisher[MsgT]: ...
    @overload
    def create_subscription(
        self,
        msg_type: Type[MsgT],
        topic: str,
        callback: GenericSubscriptionCallbackUnion[bytes],
        qos_profile: Union[QoSProfile, int],
        *,
        raw: Literal[True],
        concurrent: bool = False,
        content_filter_options: Optional[ContentFilterOptions] = None,
    ) -> AsyncSubscription[MsgT]: ...
    @overload
    def create_subscription(
        self,
        msg_type: Type[MsgT],
        topic: str,
        callback: GenericSubscriptionCallbackUnion[MsgT],
        qos_profile: Union[QoSProfile, int],
        *,
        raw: Literal[False],
        concurrent: bool = False,
        content_filter_options: Optional[ContentFilterOptions] = None,
    ) -> AsyncSubscription[MsgT]: ...
    @overload
    def create_subscription(
        self,
        msg_type: Type[MsgT],
        topic: str,
        callback: SubscriptionCallbackUnion[MsgT],
        qos_profile: Union[QoSProfile, int],
        *,
        raw: bool = False,
        concurrent: bool = False,
        content_filter_options: Optional[ContentFilterOptions] = None,
    ) -> AsyncSubscription[MsgT]: ...
    def create_subscription(
        self,
        msg_type: Type[MsgT],
        topic: str,
        callback: SubscriptionCallbackUnion[MsgT],
        qos_profile: Union[QoSProfile, int],
        *,
        raw: bool = False,
        concurrent: bool = False,
        content_filter_options: Optional[ContentFilterOptions] = None,
    ) -> AsyncSubscription[MsgT]: ...
    _create_service: Any

    def create_service(
        self,
        srv_type: Type[Srv[SrvRequestT, SrvResponseT]],
        srv_name: str,
        callback: ServiceCallbackUnion[SrvRequestT, SrvResponseT],
        *,
        qos_profile: QoSProfile = qos_profile_services_default,
        concurrent: bool = False,
    ) -> AsyncService[SrvRequestT, SrvResponseT]: ...
    def create_client(
        self,
        srv_type: Type[Srv[SrvRequestT, SrvResponseT]],
        srv_name: str,
        *,
        qos_profile: QoSProfile = qos_profile_services_default,
    ) -> AsyncClient[SrvRequestT, SrvResponseT]: ...
    def create_timer(
        self, timer_period_sec: float, callback: TimerCallbackUnion, autostart: bool = True
    ) -> AsyncTimer: ...
    _clock: Any
    _tg: Optional[asyncio.TaskGroup]
    _entities: set[AsyncEntity]
    _destroyed: Any
