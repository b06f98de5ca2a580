# Made by scripts/make_stubs.py from rclpy 7.1.6 of ROS 2 Jazzy; do not edit.
from typing import Literal
from rclpy.exceptions import InvalidNamespaceException as InvalidNamespaceException

def validate_namespace(namespace: str) -> Literal[True]: ...
