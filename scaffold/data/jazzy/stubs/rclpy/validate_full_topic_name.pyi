# Made by scripts/make_stubs.py from rclpy 7.1.6 of ROS 2 Jazzy; do not edit.
from typing import Literal
from rclpy.exceptions import InvalidServiceNameException as InvalidServiceNameException
from rclpy.exceptions import InvalidTopicNameException as InvalidTopicNameException

def validate_full_topic_name(name: str, *, is_service: bool = False) -> Literal[True]: ...
