"""LF010: launch configurations are declared before they are read."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import (
    Diagnostic,
    Example,
    LaunchRule,
    Package,
    Report,
    Severity,
    listed_names,
)
from scaffold.api.launch import LaunchCall, LaunchFile, may_be_set_elsewhere, set_names

from ._execution_order import later_declarations, steps

_LAUNCH = (
    "from launch import LaunchDescription\nfrom launch.actions import DeclareLaunchArgument\n"
    "from launch.substitutions import LaunchConfiguration\nfrom launch_ros.actions import Node\n"
    "\n\ndef generate_launch_description():\n"
    "    return LaunchDescription([\n{}"
    "        Node(package='talker', executable='talk', name={}),\n    ])\n"
)
_DECLARED = "        DeclareLaunchArgument('node', default_value='talker'),\n"
_USED = "LaunchConfiguration('node')"
_LAUNCH_ORDER = (
    "from launch import LaunchDescription\nfrom launch.actions import DeclareLaunchArgument\n"
    "from launch.substitutions import LaunchConfiguration\nfrom launch_ros.actions import Node\n"
    "\n\ndef generate_launch_description():\n"
    "    name = LaunchConfiguration('name')\n"
    "    node = Node(package='talker', executable='node', name=name)\n"
    "    return LaunchDescription([{}])\n"
)
_DECLARED_ORDER = "DeclareLaunchArgument('name', default_value='a')"


class ConfigurationUndeclared(LaunchRule):
    """A ``LaunchConfiguration`` is read but never declared, or read before its declaration.

    **Why.** Actions are executed in order, and the declaration sets the default: ``ros2 launch``
    stops with ``launch configuration 'node' does not exist``, and ``--show-args`` does not list it.

    **Fix.** ``DeclareLaunchArgument('node', default_value=...)`` in the same file, before its use.

    **Source.** ``launch/substitutions/launch_configuration.py``;
    ``launch/actions/declare_launch_argument.py``; ROS 2 documentation, "Using substitutions".
    """

    code = "LF010"
    name = "configuration-undeclared"
    other_severities = {
        Severity.WARNING: "it reads several and declares none, and may be made to be included"
    }
    examples = (
        Example(
            "declared; with a default; set by the file that includes this one",
            {
                "launch/a.launch.py": _LAUNCH.format(_DECLARED, _USED),
                "launch/b.launch.py": _LAUNCH.format("", "LaunchConfiguration('x', default='')"),
                "launch/c.launch.py": _LAUNCH.format("", "LaunchConfiguration('who')"),
                "launch/all.launch.py": "from launch.actions import IncludeLaunchDescription\n\n"
                "IncludeLaunchDescription('c.launch.py', launch_arguments={'who': 'me'}.items())\n"
                "\n\ndef generate_launch_description():\n    pass\n",
            },
        ),
        Example(
            "given on the command line of a container",
            {
                "docker/talk.dockerfile": "CMD ros2 launch talker a.launch.py \\\n"
                "    node:=${NODE}\n",
                "launch/a.launch.py": _LAUNCH.format("", _USED),
            },
        ),
        Example(
            "set by a file that builds the name of this one",
            {
                "package.xml": "<package><name>talker</name></package>\n",
                "launch/c.launch.py": _LAUNCH.format("", "LaunchConfiguration('who')"),
                "launch/all.py": "from ament_index_python import get_package_share_directory\n"
                "from launch.actions import IncludeLaunchDescription\n\n"
                "SHARE = get_package_share_directory('talker')\n\n\n"
                "def generate_launch_description(kind):\n"
                "    path = f'{SHARE}/launch/{kind}.launch.py'\n"
                "    who = {'who': 'me'}\n"
                "    return IncludeLaunchDescription(path, launch_arguments=who.items())\n",
            },
        ),
        Example(
            "set by a file that another one includes before this one",
            {
                "launch/a.launch.py": _LAUNCH.format("", _USED),
                "launch/all.yaml": "launch:\n- include:\n    file: launch/names.yaml\n"
                "- include:\n    file: launch/a.launch.py\n",
                "launch/names.yaml": "launch:\n- arg:\n    name: node\n    default: talker\n",
            },
        ),
        Example(
            "never used",
            {
                "launch/a.launch.py": _LAUNCH.format("", "'talk'").replace(
                    "    return", "    node = LaunchConfiguration('node')\n    return"
                )
            },
        ),
        Example(
            "not declared; declared under another name",
            {
                "launch/a.launch.py": _LAUNCH.format("", _USED),
                "launch/b.launch.py": _LAUNCH.format(_DECLARED, "LaunchConfiguration('nod')"),
            },
            "launch/a.launch.py:9:56: launch configuration 'node' is not declared: the launch "
            "stops; declared here: nothing",
            "launch/b.launch.py:10:56: launch configuration 'nod' is not declared: the launch "
            "stops; declared here: node",
        ),
        Example(
            "several, and none is declared: the file may be made to be included",
            {
                "launch/a.launch.py": _LAUNCH.format(
                    "", "[LaunchConfiguration('robot'), LaunchConfiguration('name')]"
                ),
            },
            Report(
                "launch/a.launch.py:9:57",
                "launch configuration 'robot' is not declared: the launch stops; declared here: "
                "nothing",
                severity=Severity.WARNING,
            ),
            Report(
                "launch/a.launch.py:9:87",
                "launch configuration 'name' is not declared: the launch stops; declared here: "
                "nothing",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "declared first",
            {"launch/a.launch.py": _LAUNCH_ORDER.format(f"{_DECLARED_ORDER}, node")},
        ),
        Example(
            "declared after its use",
            {"launch/a.launch.py": _LAUNCH_ORDER.format(f"node, {_DECLARED_ORDER}")},
            "8:12: 'name' is declared too late: the Node in line 9 reads it before it has a value",
        ),
        Example(
            "declared after a function that uses it",
            {
                "launch/a.launch.py": _LAUNCH_ORDER.format(
                    f"OpaqueFunction(function=set_up), {_DECLARED_ORDER}"
                ).replace("import Decl", "import OpaqueFunction, Decl")
                + "\n\ndef set_up(context):\n"
                "    text = LaunchConfiguration('name').perform(context)\n    return [text]\n"
            },
            "14:12: 'name' is declared too late: the OpaqueFunction in line 10 reads it before it "
            "has a value",
        ),
        Example(
            "added after its use",
            {
                "launch/a.launch.py": _LAUNCH_ORDER.format("node").replace("return", "launch =")
                + f"    launch.add_action({_DECLARED_ORDER})\n    return launch\n"
            },
            "8:12: 'name' is declared too late: the Node in line 9 reads it before it has a value",
        ),
    )

    def check_in(self, package: Package, launch: LaunchFile) -> Iterator[Diagnostic]:
        yield from self._check_declared(package, launch)
        yield from self._check_order(package, launch)

    def _check_declared(self, package: Package, launch: LaunchFile) -> Iterator[Diagnostic]:
        undeclared = _undeclared(package, launch)
        is_for_including = not launch.declared and len(undeclared) > 1
        severity = Severity.WARNING if is_for_including else None
        for name, call in undeclared.items():
            have = listed_names(launch.declared, name, "nothing")
            message = (
                f"launch configuration {name!r} is not declared: the launch stops; declared "
                f"here: {have}"
            )
            yield self.report(launch.location(call.call), message, severity=severity)

    def _check_order(self, package: Package, launch: LaunchFile) -> Iterator[Diagnostic]:
        actions = steps(launch)
        if actions is None:
            return
        declared = later_declarations(launch, actions)
        reported: set[str] = set()
        for index, step in enumerate(actions):
            for call in step.reads:
                name = str(launch.text(call, "variable_name"))
                if declared.get(name, -1) <= index or name in reported:
                    continue
                if may_be_set_elsewhere(package, launch.path, name):
                    continue
                reported.add(name)
                line = step.action.location.line
                what = f"the {step.action.kind} in line {line} reads it"
                message = f"{name!r} is declared too late: {what} before it has a value"
                yield self.report(launch.location(call.call), message)


def _undeclared(package: Package, launch: LaunchFile) -> dict[str, LaunchCall]:
    """Return the first use of each configuration that nothing declares or sets."""
    names = set_names(package, launch)
    if names is None or launch.function is None:
        return {}
    found: dict[str, LaunchCall] = {}
    for call in launch.find("LaunchConfiguration"):
        name = launch.text(call, "variable_name")
        if not isinstance(name, str) or name in names or name in found:
            continue
        if "default" in call.given or call.is_open or _is_unused(launch, call):
            continue
        if not may_be_set_elsewhere(package, launch.path, name):
            found[name] = call
    return found


def _is_unused(launch: LaunchFile, call: LaunchCall) -> bool:
    """Return whether a substitution is stored in a variable that nothing reads."""
    holder = launch.module.parent(call.call)
    if not isinstance(holder, ast.Assign) or len(holder.targets) != 1:
        return False
    target = holder.targets[0]
    return isinstance(target, ast.Name) and not any(
        isinstance(use.ctx, ast.Load) for use in launch.module.index.names(target.id)
    )
