"""ND107: simulated time is enabled from outside of the node."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Effect, Example, Package, RclpyRule, Severity
from scaffold.api.python import argument_of
from scaffold.api.rclpy import RclpyFile

_PARAMETERS = frozenset({"rclpy.parameter.Parameter", "rclpy.Parameter"})
_SIMULATION = (
    "sim",
    "gazebo",
    "gz",
    "webots",
    "isaac",
    "mujoco",
    "unity",
    "carla",
    "replay",
    "bag",
)
"""Words in the names of packages and files that always run with a simulated clock."""
_NODE = (
    "from rclpy.node import Node\nfrom rclpy.parameter import Parameter\n\n\n"
    "class Driver(Node):\n"
    "    def __init__(self{}):\n"
    "        super().__init__('driver', parameter_overrides=[\n"
    "            Parameter('use_sim_time', value={})])\n"
)


class SimTimeForced(RclpyRule):
    """A node sets its own ``use_sim_time`` parameter to true.

    **Why.** Without a publisher on ``/clock``, as on the robot, its clock stays at 0: no timer
    ever fires, and all stamps are zero.

    **Fix.** Set ``use_sim_time`` in the launch file that starts the simulation.

    **Source.** ROS 2 design, "Clock and Time".
    """

    code = "ND107"
    name = "sim-time-forced"
    severity = Severity.WARNING
    effect = Effect.WRONG_BEHAVIOR
    examples = (
        Example("off", {"driver.py": _NODE.format("", "False")}),
        Example("on request", {"driver.py": _NODE.format(", simulated", "simulated")}),
        Example(
            "always on",
            {"driver.py": _NODE.format("", "True")},
            "8:13: use_sim_time is always true: without /clock, no timer ever fires; set it in "
            "the launch file of the simulation",
        ),
        Example(
            "as an argument",
            {
                "driver.py": "import rclpy\n\n\ndef main():\n"
                "    rclpy.init(args=['--ros-args', '-p', 'use_sim_time:=true'])\n"
            },
            "5:42: use_sim_time is always true: without /clock, no timer ever fires; set it in "
            "the launch file of the simulation",
        ),
        Example("in a node of a simulation", {"sim_driver.py": _NODE.format("", "True")}),
    )

    def check_in(self, package: Package, file: RclpyFile) -> Iterator[Diagnostic]:
        if not file.module.mentions("use_sim_time") or _is_of_simulation(package, file):
            return
        for call in file.module.walk(ast.Call):
            given = _forced(file, call)
            if given is not None and not file.is_conditional(call):
                message = (
                    "use_sim_time is always true: without /clock, no timer ever fires; set it in "
                    "the launch file of the simulation"
                )
                yield self.report(file.module.location(given), message)


def _is_of_simulation(package: Package, file: RclpyFile) -> bool:
    words = f"{package.name}/{file.module.path}".lower()
    return any(word in words for word in _SIMULATION)


def _forced(file: RclpyFile, call: ast.Call) -> ast.expr | None:
    """Return the expression in a call that turns simulated time on."""
    if not _PARAMETERS.isdisjoint(file.module.qualified_names(call.func)):
        name, value = argument_of(call, "name", 0), argument_of(call, "value", 2)
        is_named = name is not None and file.evaluator.text(name) == "use_sim_time"
        is_on = value is not None and file.evaluator.evaluate(value) is True
        return call if is_named and is_on else None
    if file.module.qualified_name(call.func) == "rclpy.init" or any(
        word.arg == "cli_args" for word in call.keywords
    ):
        for text in file.module.below(call, ast.Constant):
            if isinstance(text.value, str) and text.value.lower() == "use_sim_time:=true":
                return text
    return None
