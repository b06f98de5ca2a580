# Made by scripts/make_stubs.py from rclpy 7.1.6 of ROS 2 Jazzy; do not edit.
from typing import List
from typing import Tuple
from rclpy.node import Node as Node

def get_action_client_names_and_types_by_node(
    node: Node, remote_node_name: str, remote_node_namespace: str
) -> List[Tuple[str, List[str]]]: ...
def get_action_server_names_and_types_by_node(
    node: Node, remote_node_name: str, remote_node_namespace: str
) -> List[Tuple[str, List[str]]]: ...
def get_action_names_and_types(node: Node) -> List[Tuple[str, List[str]]]: ...
