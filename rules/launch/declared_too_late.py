"""LF056: launch arguments are declared before they are read."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, LaunchRule, Package, Report
from scaffold.api.launch import LaunchFile, later_declarations, may_be_set_elsewhere, steps

_LAUNCH = (
    "from launch import LaunchDescription\nfrom launch.actions import DeclareLaunchArgument\n"
    "from launch.substitutions import LaunchConfiguration\nfrom launch_ros.actions import Node\n"
    "\n\ndef generate_launch_description():\n"
    "    name = LaunchConfiguration('name')\n"
    "    node = Node(package='talker', executable='node', name=name)\n"
    "    return LaunchDescription([{}])\n"
)
_DECLARED = "DeclareLaunchArgument('name', default_value='a')"


class DeclaredTooLate(LaunchRule):
    """A launch argument is declared after an action that reads it.

    **Why.** Actions are executed in their order, and the default is set by the declaration:
    ``launch configuration 'name' does not exist``, unless somebody gives it on the command line.

    **Fix.** Put the declarations first.

    **Source.** ``launch/actions/declare_launch_argument.py``; ``launch/launch_service.py``.
    """

    code = "LF056"
    name = "declared-too-late"
    examples = (
        Example("first", {"launch/a.launch.py": _LAUNCH.format(f"{_DECLARED}, node")}),
        Example(
            "after",
            {"launch/a.launch.py": _LAUNCH.format(f"node, {_DECLARED}")},
            Report(
                "8:12",
                "'name' is declared after its use: the Node in line 9 reads it "
                "before it has a value",
            ),
        ),
        Example(
            "after a function",
            {
                "launch/a.launch.py": _LAUNCH.format(
                    f"OpaqueFunction(function=set_up), {_DECLARED}"
                ).replace("import Decl", "import OpaqueFunction, Decl")
                + "\n\ndef set_up(context):\n"
                "    text = LaunchConfiguration('name').perform(context)\n    return [text]\n"
            },
            Report(
                "14:12",
                "'name' is declared after its use: the OpaqueFunction in line 10 "
                "reads it before it has a value",
            ),
        ),
        Example(
            "added after",
            {
                "launch/a.launch.py": _LAUNCH.format("node").replace("return", "launch =")
                + f"    launch.add_action({_DECLARED})\n    return launch\n"
            },
            Report(
                "8:12",
                "'name' is declared after its use: the Node in line 9 reads it "
                "before it has a value",
            ),
        ),
    )

    def check_in(self, package: Package, launch: LaunchFile) -> Iterator[Diagnostic]:
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
                if may_be_set_elsewhere(package, launch, name):
                    continue
                reported.add(name)
                line = step.action.location.line
                what = f"the {step.action.kind} in line {line} reads it"
                message = f"{name!r} is declared after its use: {what} before it has a value"
                yield self.report(launch.location(call.call), message)
