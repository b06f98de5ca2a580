from typing import Any
from launch_ros.descriptions.composable_node import ComposableNode as ComposableNode
from launch_ros.parameter_descriptions import Parameter as Parameter
from launch_ros.parameter_descriptions import ParameterFile as ParameterFile
from launch_ros.parameter_descriptions import ParameterValue as ParameterValue

class ComposableLifecycleNode(ComposableNode):
    def __init__(self, *, autostart: bool = False, **kwargs: Any) -> None: ...
