from typing import Any
from _ros_launch import Environment, Listed, Reaction
from launch.condition import Condition
from launch.events.process.process_exited import ProcessExited
from launch.some_substitutions_type import SomeSubstitutionsType as SomeSubstitutionsType
from launch_ros.actions.node import Node
from launch_ros.descriptions.composable_node import ComposableNode as ComposableNode
from launch_ros.parameters_type import SomeParameters as SomeParameters
from launch_ros.remap_rule_type import SomeRemapRules as SomeRemapRules
from launch.action import Action as Action
from launch.frontend import Entity as Entity
from launch.frontend import expose_action as expose_action
from launch.frontend import Parser as Parser
from launch.launch_context import LaunchContext as LaunchContext
from ..descriptions import ComposableLifecycleNode as ComposableLifecycleNode

class ComposableNodeContainer(Node):
    def __init__(
        self,
        *,
        executable: SomeSubstitutionsType,
        name: SomeSubstitutionsType,
        namespace: SomeSubstitutionsType,
        package: SomeSubstitutionsType | None = None,
        composable_node_descriptions: list[ComposableNode] | None = None,
        parameters: SomeParameters | None = None,
        remappings: SomeRemapRules | None = None,
        ros_arguments: Listed[SomeSubstitutionsType] | None = None,
        arguments: Listed[SomeSubstitutionsType] | None = None,
        exec_name: SomeSubstitutionsType | None = None,
        prefix: SomeSubstitutionsType | None = None,
        cwd: SomeSubstitutionsType | None = None,
        env: Environment | None = None,
        additional_env: Environment | None = None,
        shell: bool = False,
        sigterm_timeout: SomeSubstitutionsType = ...,
        sigkill_timeout: SomeSubstitutionsType = ...,
        emulate_tty: bool = False,
        output: SomeSubstitutionsType | dict[str, Any] = "log",
        output_format: str = ...,
        cached_output: bool = False,
        log_cmd: bool = False,
        on_exit: Reaction[ProcessExited] | None = None,
        respawn: bool | SomeSubstitutionsType = False,
        respawn_delay: float | None = None,
        respawn_max_retries: int = -1,
        condition: Condition | None = None,
    ) -> None: ...
