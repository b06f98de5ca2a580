# Made by scripts/make_stubs.py from rclpy 7.1.6 of ROS 2 Jazzy; do not edit.
from typing import Literal
from rclpy.exceptions import InvalidNodeNameException as InvalidNodeNameException

def validate_node_name(node_name: str) -> Literal[True]: ...
