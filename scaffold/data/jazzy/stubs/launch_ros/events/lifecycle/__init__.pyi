from launch_ros.events.lifecycle.change_state import ChangeState as ChangeState
from launch_ros.events.lifecycle.lifecycle_node_matchers import (
    matches_node_name as matches_node_name,
)
from launch_ros.events.lifecycle.state_transition import (
    StateTransition as StateTransition,
)
