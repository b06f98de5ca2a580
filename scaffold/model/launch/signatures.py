"""The parameters of launch actions, substitutions and handlers, as on Jazzy."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache

from scaffold.record import NamedTuple

_PROCESS = (
    "prefix cwd env additional_env shell sigterm_timeout sigkill_timeout emulate_tty output "
    "output_format cached_output log_cmd on_exit respawn respawn_delay respawn_max_retries "
    "process_description"
)
_NODE = (
    "package exec_name parameters remappings ros_arguments arguments cmd "
    f"composable_node_descriptions {_PROCESS}"
)
_HANDLER = "target_action handle_once matcher entities target_lifecycle_node"

# Keyword-only parameters follow "/"; "*" marks required ones.
_ACTIONS: Mapping[str, str] = {
    "AppendEnvironmentVariable": "name* value* prepend separator",
    "ComposableNodeContainer": f"/ name* namespace* executable {_NODE}",
    "DeclareLaunchArgument": "name* / default_value description choices",
    "EmitEvent": "/ event*",
    "ExecuteProcess": f"/ cmd* name {_PROCESS}",
    "GroupAction": "actions* / scoped forwarding launch_configurations",
    "IncludeLaunchDescription": "launch_description_source* / launch_arguments",
    "LifecycleNode": f"/ name* namespace* executable autostart {_NODE}",
    "LoadComposableNodes": "/ composable_node_descriptions* target_container*",
    "LogInfo": "/ msg*",
    "Node": f"/ executable name namespace {_NODE}",
    "OpaqueFunction": "/ function* args kwargs",
    "PushROSNamespace": "namespace*",
    "PushRosNamespace": "namespace*",
    "RegisterEventHandler": "event_handler*",
    "SetEnvironmentVariable": "name* value*",
    "SetLaunchConfiguration": "name* value*",
    "SetParameter": "name* value*",
    "SetParametersFromFile": "filename* / node_name",
    "SetRemap": "src* dst*",
    "Shutdown": "/ reason",
    "TimerAction": "/ period* actions* cancel_on_shutdown",
    "UnsetEnvironmentVariable": "name*",
    "UnsetLaunchConfiguration": "name*",
}
_OTHERS: Mapping[str, str] = {
    "AndSubstitution": "left* right*",
    "AnyLaunchDescriptionSource": "launch_file_path*",
    "Command": "command* / on_stderr",
    "ComposableNode": (
        "/ package* plugin* name namespace parameters remappings extra_arguments condition"
    ),
    "EnvironmentVariable": "name* / default_value",
    "EqualsSubstitution": "left* right*",
    "FindExecutable": "/ name*",
    "FindPackagePrefix": "package*",
    "FindPackageShare": "package*",
    "IfCondition": "predicate_expression*",
    "IfElseSubstitution": "condition* if_value else_value",
    "LaunchConfiguration": "variable_name* / default",
    "LaunchConfigurationEquals": "launch_configuration_name* expected_value*",
    "LaunchConfigurationNotEquals": "launch_configuration_name* expected_value*",
    "LaunchDescription": "initial_entities / deprecated_reason",
    "NotEqualsSubstitution": "left* right*",
    "NotSubstitution": "value*",
    "OnExecutionComplete": f"/ on_completion* {_HANDLER}",
    "OnProcessExit": f"/ on_exit* {_HANDLER}",
    "OnProcessIO": f"/ on_stdin on_stdout on_stderr {_HANDLER}",
    "OnProcessStart": f"/ on_start* {_HANDLER}",
    "OnShutdown": "/ on_shutdown* handle_once matcher entities",
    "OrSubstitution": "left* right*",
    "PathJoinSubstitution": "substitutions*",
    "PythonExpression": "expression* python_modules",
    "PythonLaunchDescriptionSource": "launch_file_path*",
    "TextSubstitution": "/ text*",
    "UnlessCondition": "predicate_expression*",
    "XMLLaunchDescriptionSource": "launch_file_path*",
    "YAMLLaunchDescriptionSource": "launch_file_path*",
}

ACTIONS = frozenset(_ACTIONS)
"""The classes allowed in the list of a LaunchDescription."""


class Signature(NamedTuple):
    """The arguments of a class of launch."""

    positional: tuple[str, ...]
    names: frozenset[str]
    required: tuple[str, ...]


def signature(kind: str) -> Signature | None:
    """Return the arguments of a class of launch; ``None`` if unknown."""
    return _signatures().get(kind)


@cache
def _signatures() -> Mapping[str, Signature]:
    of_actions = {kind: _read(text, "condition") for kind, text in _ACTIONS.items()}
    return {kind: _read(text) for kind, text in _OTHERS.items()} | of_actions


def _read(text: str, *more: str) -> Signature:
    first, _, _ = text.partition("/")
    names = [name for name in text.split() if name != "/"]
    return Signature(
        tuple(name.rstrip("*") for name in first.split()),
        frozenset((*more, *(name.rstrip("*") for name in names))),
        tuple(name[:-1] for name in names if name.endswith("*")),
    )
