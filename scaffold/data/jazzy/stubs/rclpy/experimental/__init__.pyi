# Made by scripts/make_stubs.py from rclpy 7.1.6 of ROS 2 Jazzy; do not edit.
from .events_executor import EventsExecutor as EventsExecutor
