from launch_ros.actions.composable_node_container import (
    ComposableNodeContainer as ComposableNodeContainer,
)
from launch_ros.actions.lifecycle_node import LifecycleNode as LifecycleNode
from launch_ros.actions.lifecycle_transition import (
    LifecycleTransition as LifecycleTransition,
)
from launch_ros.actions.load_composable_nodes import (
    LoadComposableNodes as LoadComposableNodes,
)
from launch_ros.actions.node import Node as Node
from launch_ros.actions.push_ros_namespace import PushROSNamespace as PushROSNamespace
from launch_ros.actions.ros_timer import ROSTimer as ROSTimer
from launch_ros.actions.set_parameter import SetParameter as SetParameter
from launch_ros.actions.set_parameters_from_file import (
    SetParametersFromFile as SetParametersFromFile,
)
from launch_ros.actions.set_remap import SetRemap as SetRemap
from launch_ros.actions.set_ros_log_dir import SetROSLogDir as SetROSLogDir
from launch_ros.actions.set_use_sim_time import SetUseSimTime as SetUseSimTime

PushRosNamespace = PushROSNamespace
RosTimer = ROSTimer
