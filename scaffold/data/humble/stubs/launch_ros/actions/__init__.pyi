from launch_ros.actions.composable_node_container import (
    ComposableNodeContainer as ComposableNodeContainer,
)
from launch_ros.actions.lifecycle_node import LifecycleNode as LifecycleNode
from launch_ros.actions.lifecycle_transition import LifecycleTransition as LifecycleTransition
from launch_ros.actions.load_composable_nodes import LoadComposableNodes as LoadComposableNodes
from launch_ros.actions.node import Node as Node
from launch_ros.actions.set_parameter import SetParameter as SetParameter
from launch_ros.actions.set_parameters_from_file import (
    SetParametersFromFile as SetParametersFromFile,
)
from launch_ros.actions.set_remap import SetRemap as SetRemap
from launch_ros.actions.set_use_sim_time import SetUseSimTime as SetUseSimTime
from .push_ros_namespace import PushRosNamespace as PushRosNamespace
from .ros_timer import RosTimer as RosTimer

PushRosNamespace = PushROSNamespace
RosTimer = ROSTimer
