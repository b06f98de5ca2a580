from typing import Any

from _ros_launch import Environment, Listed, Reaction
from launch.actions.execute_process import ExecuteProcess as ExecuteProcess
from launch.condition import Condition
from launch.events.process.process_exited import ProcessExited
from launch.some_substitutions_type import (
    SomeSubstitutionsType as SomeSubstitutionsType,
)
from launch_ros.parameters_type import SomeParameters as SomeParameters
from launch_ros.remap_rule_type import SomeRemapRules as SomeRemapRules

class NodeActionExtension:
    NAME: Any
    EXTENSION_POINT_VERSION: str
    def prepare_for_execute(
        self, context: Any, ros_specific_arguments: Any, node_action: Any
    ) -> Any: ...

class Node(ExecuteProcess):
    UNSPECIFIED_NODE_NAME: str
    UNSPECIFIED_NODE_NAMESPACE: str
    def __init__(
        self,
        *,
        executable: SomeSubstitutionsType,
        package: SomeSubstitutionsType | None = None,
        name: SomeSubstitutionsType | None = None,
        namespace: SomeSubstitutionsType | None = None,
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
    @property
    def node_package(self) -> Any: ...
    @property
    def node_executable(self) -> Any: ...
    @property
    def node_name(self) -> str: ...
    def is_node_name_fully_specified(self) -> bool: ...
    @property
    def expanded_node_namespace(self) -> str: ...
    @property
    def expanded_remapping_rules(self) -> list[tuple[str, str]] | None: ...

def __getattr__(name: str) -> Any: ...
