from collections.abc import Sequence
from typing import Any
from launch.action import Action as Action
from launch.condition import Condition
from launch.some_substitutions_type import SomeSubstitutionsType as SomeSubstitutionsType
from launch_ros.actions.composable_node_container import (
    ComposableNodeContainer as ComposableNodeContainer,
)
from launch_ros.descriptions.composable_node import ComposableNode as ComposableNode
from launch.frontend import Entity as Entity
from launch.frontend import expose_action as expose_action
from launch.frontend import Parser as Parser
from launch.launch_context import LaunchContext as LaunchContext
from launch.some_substitutions_type import (
    SomeSubstitutionsType_types_tuple as SomeSubstitutionsType_types_tuple,
)
from launch.utilities import ensure_argument_type as ensure_argument_type
from launch.utilities import is_a_subclass as is_a_subclass
from launch.utilities import (
    normalize_to_list_of_substitutions as normalize_to_list_of_substitutions,
)
from launch.utilities import perform_substitutions as perform_substitutions
from launch.utilities import type_utils as type_utils
from launch_ros.parameter_descriptions import ParameterFile as ParameterFile
from .lifecycle_transition import LifecycleTransition as LifecycleTransition
from ..descriptions import ComposableLifecycleNode as ComposableLifecycleNode
from ..ros_adapters import get_ros_node as get_ros_node
from ..utilities import add_node_name as add_node_name
from ..utilities import evaluate_parameters as evaluate_parameters
from ..utilities import get_node_name_count as get_node_name_count
from ..utilities import make_namespace_absolute as make_namespace_absolute
from ..utilities import prefix_namespace as prefix_namespace
from ..utilities import to_parameters_list as to_parameters_list
from ..utilities.normalize_parameters import normalize_parameter_dict as normalize_parameter_dict

class LoadComposableNodes(Action):
    def __init__(
        self,
        *,
        composable_node_descriptions: Sequence[ComposableNode],
        target_container: SomeSubstitutionsType | ComposableNodeContainer,
        condition: Condition | None = None,
    ) -> None: ...

def get_composable_node_load_request(
    composable_node_description: ComposableNode, context: Any
) -> Any: ...
