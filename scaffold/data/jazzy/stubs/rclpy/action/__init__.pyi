# Made by scripts/make_stubs.py from rclpy 7.1.6 of ROS 2 Jazzy; do not edit.
from .client import ActionClient as ActionClient
from .graph import (
    get_action_client_names_and_types_by_node as get_action_client_names_and_types_by_node,
)
from .graph import get_action_names_and_types as get_action_names_and_types
from .graph import (
    get_action_server_names_and_types_by_node as get_action_server_names_and_types_by_node,
)
from .server import (
    ActionServer as ActionServer,
    CancelResponse as CancelResponse,
    GoalResponse as GoalResponse,
)
