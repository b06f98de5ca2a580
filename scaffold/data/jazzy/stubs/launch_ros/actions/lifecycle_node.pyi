from typing import Any

from _ros_launch import Environment, Listed, Reaction
from launch.condition import Condition
from launch.events.process.process_exited import ProcessExited
from launch.some_substitutions_type import (
    SomeSubstitutionsType as SomeSubstitutionsType,
)
from launch_ros.actions.node import Node
from launch_ros.parameters_type import SomeParameters as SomeParameters
from launch_ros.remap_rule_type import SomeRemapRules as SomeRemapRules

class LifecycleNode(Node):
    def __init__(
        self,
        *,
        executable: SomeSubstitutionsType,
        name: SomeSubstitutionsType,
        namespace: SomeSubstitutionsType,
        package: SomeSubstitutionsType | None = None,
        autostart: bool = False,
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
    def node_autostart(self) -> bool: ...
