import asyncio
from typing import Any, Callable, Optional, Type
from rclpy.executors import await_or_execute as await_or_execute
from rclpy.qos import QoSProfile as QoSProfile
from rclpy.service import BaseService as BaseService, ServiceCallbackUnion as ServiceCallbackUnion
from rclpy.type_support import Srv as Srv, SrvRequestT as SrvRequestT, SrvResponseT as SrvResponseT

class AsyncService(BaseService[SrvRequestT, SrvResponseT]):
    def __init__(
        self,
        service_impl: object,
        srv_type: Type[Srv[SrvRequestT, SrvResponseT]],
        srv_name: str,
        callback: ServiceCallbackUnion[SrvRequestT, SrvResponseT],
        qos_profile: QoSProfile,
        on_destroy: Callable[["AsyncService"], None],
        concurrent: bool = False,
        tg: Optional[asyncio.TaskGroup] = None,
    ) -> None: ...
    _on_new_request: Any
    _destroy: Any
    _handle_request: Any
    _requests: Any
    _run: Any
    _concurrent: Any
    _task: Optional[asyncio.Task]
    _loop: Optional[asyncio.AbstractEventLoop]
    _read_event: Any
