from typing import Any
from rcl_interfaces.msg import (
    LoggerLevel as LoggerLevel,
    SetLoggerLevelsResult as SetLoggerLevelsResult,
)
from rcl_interfaces.srv import GetLoggerLevels as GetLoggerLevels
from rcl_interfaces.srv import SetLoggerLevels as SetLoggerLevels
from rclpy.impl.logging_severity import LoggingSeverity as LoggingSeverity
from rclpy.qos import qos_profile_services_default as qos_profile_services_default
from rclpy.validate_topic_name import TOPIC_SEPARATOR_STRING as TOPIC_SEPARATOR_STRING
from rclpy.node import BaseNode as BaseNode

class LoggingService:
    def __init__(self, node: Node) -> None: ...
    _get_logger_levels: Any
    _set_logger_levels: Any
