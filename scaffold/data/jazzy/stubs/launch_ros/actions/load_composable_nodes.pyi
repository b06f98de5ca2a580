from collections.abc import Sequence
from typing import Any

from launch.action import Action as Action
from launch.condition import Condition
from launch.some_substitutions_type import (
    SomeSubstitutionsType as SomeSubstitutionsType,
)
from launch_ros.actions.composable_node_container import (
    ComposableNodeContainer as ComposableNodeContainer,
)
from launch_ros.descriptions.composable_node import ComposableNode as ComposableNode

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
