from typing import Any
from rcl_interfaces.msg import ParameterDescriptor as ParameterDescriptor
from rcl_interfaces.msg import ParameterType as ParameterType
from rclpy.parameter import Parameter as Parameter
from rclpy.qos import qos_profile_services_default as qos_profile_services_default
from rclpy.type_support import check_is_valid_srv_type as check_is_valid_srv_type
from rclpy.validate_topic_name import TOPIC_SEPARATOR_STRING as TOPIC_SEPARATOR_STRING
from type_description_interfaces.srv import GetTypeDescription as GetTypeDescription
from rclpy.node import BaseNode as BaseNode

START_TYPE_DESCRIPTION_SERVICE_PARAM: str

class TypeDescriptionService:
    def __init__(self, node: Any) -> None: ...
    _start_service: Any
    _service_callback: Any
    _get_node: Any
    _node_weak_ref: Any
    service_name: Any
    _type_description_srv: Any
    enabled: bool
