# Made by scripts/make_stubs.py from rclpy 7.1.6 of ROS 2 Jazzy; do not edit.
from rpyutils import import_c_library as import_c_library
from typing import Any

package: str
rclpy_implementation: Any
