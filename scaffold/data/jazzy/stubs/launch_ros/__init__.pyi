from launch_ros import actions as actions
from launch_ros import descriptions as descriptions
from launch_ros import event_handlers as event_handlers
from launch_ros import events as events
from launch_ros import ros_adapters as ros_adapters
from launch_ros import substitutions as substitutions
