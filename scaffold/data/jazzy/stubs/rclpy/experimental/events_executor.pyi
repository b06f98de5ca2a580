# Made by scripts/make_stubs.py from rclpy 7.1.6 of ROS 2 Jazzy; do not edit.
from typing import Optional
from rclpy.context import Context
from rclpy.executors import Executor

def EventsExecutor(*, context: Optional[Context] = None) -> Executor: ...
