"""What launch files in XML may contain: elements, their attributes, and substitutions."""

from __future__ import annotations

from collections.abc import Mapping

_CONDITIONS = frozenset({"if", "unless"})
_PROCESS = frozenset(
    [
        "name",
        "cwd",
        "launch-prefix",
        "output",
        "respawn",
        "respawn_max_retries",
        "respawn_delay",
        "sigkill_timeout",
        "sigterm_timeout",
        "shell",
        "emulate_tty",
        "on_exit",
    ]
)
_NODE = _PROCESS | frozenset(
    ["pkg", "exec", "namespace", "args", "ros_args", "exec_name", "node-name"]
)
_NAME_AND_VALUE = frozenset({"name", "value"})

ACTIONS: Mapping[str, frozenset[str]] = {
    "append_env": _NAME_AND_VALUE | {"prepend", "separator"},
    "arg": frozenset({"name", "default", "value", "description"}),
    "composable_node": frozenset({"pkg", "plugin", "name", "namespace"}),
    "executable": _PROCESS | {"cmd"},
    "group": frozenset({"scoped", "forwarding"}),
    "include": frozenset({"file"}),
    "let": _NAME_AND_VALUE,
    "load_composable_node": frozenset({"target"}),
    "node": _NODE,
    "node_container": _NODE,
    "push-ros-namespace": frozenset({"namespace"}),
    "push_ros_namespace": frozenset({"namespace"}),
    "set_env": _NAME_AND_VALUE,
    "set_parameter": _NAME_AND_VALUE,
    "set_parameters_from_file": frozenset({"filename"}),
    "set_remap": frozenset({"from", "to"}),
    "set_use_sim_time": frozenset({"value"}),
    "unset_env": frozenset({"name"}),
}
"""The attributes of actions; all have conditions as well."""
PARTS: Mapping[str, frozenset[str]] = {
    "env": _NAME_AND_VALUE,
    "extra_arg": _NAME_AND_VALUE,
    "param": _NAME_AND_VALUE | {"from", "type", "allow_substs"},
    "remap": frozenset({"from", "to"}),
}
"""The attributes of what is part of an action; a condition is refused there."""
REQUIRED: Mapping[str, tuple[str, ...]] = {
    "executable": ("cmd",),
    "include": ("file",),
    "let": ("name", "value"),
    "node": ("exec",),
    "push-ros-namespace": ("namespace",),
    "push_ros_namespace": ("namespace",),
    "remap": ("from", "to"),
    "set_remap": ("from", "to"),
}
SUBSTITUTIONS = frozenset(
    [
        "all",
        "and",
        "anon",
        "any",
        "command",
        "dirname",
        "env",
        "equals",
        "eval",
        "exec-in-pkg",
        "file-content",
        "filename",
        "find-exec",
        "find-pkg-prefix",
        "find-pkg-share",
        "if",
        "launch_log_dir",
        "log_dir",
        "not",
        "not-equals",
        "or",
        "param",
        "var",
    ]
)
OF_PYTHON: Mapping[str, str] = {
    "arguments": "args",
    "condition": "if",
    "default_value": "default",
    "executable": "exec",
    "launch_arguments": "<arg name='...' value='...'/>",
    "package": "pkg",
    "parameters": "<param .../>",
    "prefix": "launch-prefix",
    "remappings": "<remap .../>",
}
"""Arguments of launch files in Python, and the equivalent in XML."""


def attributes_of(tag: str) -> frozenset[str] | None:
    """Return the attributes that an element may have; ``None`` if it is not known."""
    if tag in PARTS:
        return PARTS[tag]
    return ACTIONS[tag] | _CONDITIONS if tag in ACTIONS else None
