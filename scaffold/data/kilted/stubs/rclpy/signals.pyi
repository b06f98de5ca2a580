from typing import Any
from rclpy.exceptions import InvalidHandle as InvalidHandle
from rclpy.guard_condition import GuardCondition as GuardCondition
from enum import Enum
from rclpy.context import Context as Context

class SignalHandlerOptions(Enum):
    NO = 0
    SIGINT = 1
    SIGTERM = 2
    ALL = 3

def install_signal_handlers(options: SignalHandlerOptions = SignalHandlerOptions.ALL) -> None: ...
def get_current_signal_handlers_options() -> SignalHandlerOptions: ...
def uninstall_signal_handlers() -> None: ...

class SignalHandlerGuardCondition(GuardCondition):
    def __init__(self, context: Any = None) -> None: ...
    def destroy(self) -> None: ...
