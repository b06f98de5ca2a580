# Made by scripts/make_stubs.py from rclpy 7.1.6 of ROS 2 Jazzy; do not edit.
from typing import Any

package: str
rclpy_implementation: Any
