from launch_ros.events.matchers.matches_node_name import (
    matches_node_name as matches_node_name,
)
