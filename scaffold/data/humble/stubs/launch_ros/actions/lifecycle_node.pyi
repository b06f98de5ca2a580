from typing import Any
from launch.some_substitutions_type import SomeSubstitutionsType as SomeSubstitutionsType
from launch_ros.actions.node import Node
from launch_ros.parameters_type import SomeParameters as SomeParameters
from launch_ros.remap_rule_type import SomeRemapRules as SomeRemapRules
from launch.action import Action as Action
from ..events.lifecycle import ChangeState as ChangeState
from ..events.lifecycle import StateTransition as StateTransition
from ..ros_adapters import get_ros_node as get_ros_node

class LifecycleNode(Node):
    def __init__(
        self, *, name: SomeSubstitutionsType, namespace: SomeSubstitutionsType, **kwargs: Any
    ) -> None: ...
    _on_transition_event: Any
    _call_change_state: Any
    _on_change_state_event: Any
    __rclpy_subscription: Any
    __current_state: Any
    __rclpy_change_state_client: Any
