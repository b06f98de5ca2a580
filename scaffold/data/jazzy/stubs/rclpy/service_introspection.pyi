# Made by scripts/make_stubs.py from rclpy 7.1.6 of ROS 2 Jazzy; do not edit.
from enum import Enum

class ServiceIntrospectionState(Enum):
    OFF = 0
    METADATA = 1
    CONTENTS = 2
