from typing import Any
from rcl_interfaces.msg import ListParametersResult as ListParametersResult
from rcl_interfaces.msg import SetParametersResult as SetParametersResult
from rcl_interfaces.srv import (
    DescribeParameters as DescribeParameters,
    GetParameters as GetParameters,
    GetParameterTypes as GetParameterTypes,
)
from rcl_interfaces.srv import (
    ListParameters as ListParameters,
    SetParameters as SetParameters,
    SetParametersAtomically as SetParametersAtomically,
)
from rclpy.exceptions import (
    ParameterNotDeclaredException as ParameterNotDeclaredException,
    ParameterUninitializedException as ParameterUninitializedException,
)
from rclpy.parameter import Parameter as Parameter
from rclpy.qos import qos_profile_parameters as qos_profile_parameters
from rclpy.validate_topic_name import TOPIC_SEPARATOR_STRING as TOPIC_SEPARATOR_STRING
from rclpy.node import BaseNode as BaseNode

class ParameterService:
    def __init__(self, node: Any) -> None: ...
    _describe_parameters_callback: Any
    _get_parameters_callback: Any
    _get_parameter_types_callback: Any
    _list_parameters_callback: Any
    _set_parameters_callback: Any
    _set_parameters_atomically_callback: Any
    _get_node: Any
    _node_weak_ref: Any
