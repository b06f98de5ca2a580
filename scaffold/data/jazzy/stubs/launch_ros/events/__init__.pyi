from launch_ros.events import lifecycle as lifecycle
from launch_ros.events.matchers import matches_node_name as matches_node_name
