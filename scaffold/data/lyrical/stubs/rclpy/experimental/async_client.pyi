from typing import Any
import asyncio
from typing import Callable, Dict, Optional, Type
from rclpy.client import BaseClient as BaseClient
from rclpy.context import Context as Context
from rclpy.qos import QoSProfile as QoSProfile
from rclpy.type_support import Srv as Srv, SrvRequestT as SrvRequestT, SrvResponseT as SrvResponseT

class AsyncClient(BaseClient[SrvRequestT, SrvResponseT]):
    def __init__(
        self,
        context: Context,
        client_impl: object,
        srv_type: Type[Srv[SrvRequestT, SrvResponseT]],
        srv_name: str,
        qos_profile: QoSProfile,
        on_destroy: Callable[["AsyncClient"], None],
        tg: Optional[asyncio.TaskGroup] = None,
    ) -> None: ...
    _on_new_response: Any

    async def wait_for_service(self, *, check_interval: float = 0.1) -> None: ...
    _destroy: Any

    async def call(self, request: SrvRequestT) -> SrvResponseT: ...
    _responses: Any
    _run: Any
    _pending_requests: Dict[int, asyncio.Future]
    _task: Optional[asyncio.Task]
    _loop: Optional[asyncio.AbstractEventLoop]
    _read_event: Any
