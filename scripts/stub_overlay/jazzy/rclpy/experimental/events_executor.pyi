from typing import Optional
from rclpy.context import Context
from rclpy.executors import Executor

def EventsExecutor(*, context: Optional[Context] = None) -> Executor: ...
