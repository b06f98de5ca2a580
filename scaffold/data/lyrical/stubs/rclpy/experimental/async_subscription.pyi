from typing import Any
import asyncio
from typing import Callable, Optional, Type
from rclpy.executors import await_or_execute as await_or_execute
from rclpy.qos import QoSProfile as QoSProfile
from rclpy.subscription import (
    BaseSubscription as BaseSubscription,
    SubscriptionCallbackUnion as SubscriptionCallbackUnion,
)
from rclpy.type_support import MsgT as MsgT

class AsyncSubscription(BaseSubscription[MsgT]):
    def __init__(
        self,
        subscription_impl: object,
        msg_type: Type[MsgT],
        topic: str,
        callback: SubscriptionCallbackUnion[MsgT],
        qos_profile: QoSProfile,
        on_destroy: Callable[["AsyncSubscription"], None],
        raw: bool = False,
        concurrent: bool = False,
        tg: Optional[asyncio.TaskGroup] = None,
    ) -> None: ...
    _on_new_message: Any
    _destroy: Any
    _messages: Any
    _make_callback: Any
    _run: Any
    _concurrent: Any
    _task: Optional[asyncio.Task]
    _loop: Optional[asyncio.AbstractEventLoop]
    _read_event: Any
