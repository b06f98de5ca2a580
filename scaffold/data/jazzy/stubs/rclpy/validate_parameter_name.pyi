# Made by scripts/make_stubs.py from rclpy 7.1.6 of ROS 2 Jazzy; do not edit.
from typing import Literal
from rclpy.exceptions import InvalidParameterException as InvalidParameterException

def validate_parameter_name(name: str) -> Literal[True]: ...
