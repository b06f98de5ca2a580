"""LF042: what a launch file makes is launched."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Rule
from scaffold.model.launch_py import FUNCTION, NODES, LaunchCall, LaunchFile

_LAUNCH = (
    "from launch import LaunchDescription\nfrom launch.actions import OpaqueFunction\n"
    "from launch_ros.actions import Node\n\n\n"
    "def set_up(context):\n    return []\n\n\n"
    "def generate_launch_description({}):\n"
    "    talker = Node(package='talker', {})\n"
    "    description = LaunchDescription([talker])\n"
    "    {}\n"
    "    return description\n"
)
_RIGHT = ("", "executable='node'", "description.add_action(OpaqueFunction(function=set_up))")


class DescriptionIncomplete(Rule):
    """A launch file makes an action that it does not return, or makes it in a way that fails.

    **Why.** An action that is in no list is never executed, without a word; the others end in
    ``TypeError`` when ``ros2 launch`` reads the file.

    **Fix.** Put it in the list; ``Node`` needs ``executable``; ``LaunchDescription`` takes one
    list; ``generate_launch_description`` takes no arguments.

    **Source.** ``launch/launch_description.py``; ``launch_ros/actions/node.py``.
    """

    code = "LF042"
    name = "description-incomplete"
    examples = (
        Example("complete", {"launch/a.launch.py": _LAUNCH.format(*_RIGHT)}),
        Example(
            "add_action of a class of one's own",
            {
                "launch/a.launch.py": _LAUNCH.format(*_RIGHT)
                + "\n\nclass Launcher:\n    def node(self, made):\n"
                "        return self.add_action(made)\n"
            },
        ),
        Example(
            "an argument, no program, an action that is not added",
            {
                "launch/a.launch.py": _LAUNCH.format(
                    "context", "name='node'", "Node(package='talker', executable='node')"
                )
            },
            at=("launch/a.launch.py:10", "launch/a.launch.py:11", "launch/a.launch.py:13"),
        ),
        Example(
            "several arguments, a function that is called, what add_action returns",
            {
                "launch/a.launch.py": _LAUNCH.format(*_RIGHT)
                .replace("([talker])", "(talker, talker, talker)")
                .replace("function=set_up", "function=set_up()")
                .replace("return description", "return description.add_action(talker)")
            },
            at=("launch/a.launch.py:12", "launch/a.launch.py:13", "launch/a.launch.py:14"),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for launch in LaunchFile.of_package(package):
            function = launch.function
            if function is not None:
                arguments = function.node.args
                given = [*arguments.posonlyargs, *arguments.args]
                if len(given) > len(arguments.defaults):
                    message = f"`ros2 launch` calls {FUNCTION} without arguments: TypeError"
                    yield self.report(function, message)
            for call in launch.calls:
                problem = _problem(launch, call)
                if problem:
                    yield self.report(call, problem)
            for statement in launch.module.walk(ast.Return):
                if function is None or (
                    launch.module.enclosing_function(statement) is not function.node
                ):
                    continue
                match statement.value:
                    case ast.Call(func=ast.Attribute(attr="add_action" | "add_entity")):
                        message = "add_action() returns nothing: return the LaunchDescription"
                        yield self.report(launch.location(statement), message)


def _problem(launch: LaunchFile, call: LaunchCall) -> str:
    parent = launch.module.parent(call.call)
    if call.kind in {*NODES, "IncludeLaunchDescription", "ExecuteProcess"} and isinstance(
        parent, ast.Expr
    ):
        return f"this {call.kind} is in no list: it is never executed"
    if call.kind in NODES and not call.is_open and not call.call.args:
        if "executable" not in call.given and "node_executable" not in call.given:
            return f"{call.kind} needs executable=...: TypeError"
        if "package" not in call.given and _is_script(launch, call):
            return f"{call.kind} has no package=...: the program is looked for on the PATH"
    if call.kind == "LaunchDescription" and len(call.call.args) > 1:
        second = launch.call_of(call.call.args[1])
        if second is not None:
            return "LaunchDescription takes one list of actions: put them in [...]"
    function = call.given.get("function")
    if call.kind == "OpaqueFunction" and function is None and call.call.args:
        function = call.call.args[0]
    return _called_problem(launch, function)


def _called_problem(launch: LaunchFile, node: ast.expr | None) -> str:
    """Return what is wrong about a function that is called where it should be passed."""
    match node:
        case ast.Call(func=ast.Name(id=name), args=[]) if name in launch.module.functions:
            return f"{name}() is called here: pass the function itself"
    return ""


def _is_script(launch: LaunchFile, call: LaunchCall) -> bool:
    """Tell whether a program is named that is surely not on the path of programs."""
    name = launch.text(call, "executable")
    return isinstance(name, str) and name.endswith(".py") and "/" not in name
