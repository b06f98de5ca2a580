"""ND017: the value of a parameter is used, not the Parameter."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Edit, Example, Fix, RclpyRule, Report
from scaffold.api.rclpy import RclpyFile, objects_used

_NODE = (
    "from rclpy.node import Node\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "        self.declare_parameter('rate', 2.0)\n"
    "        rate = self.get_parameter('rate'){}\n"
    "        self.create_timer(1.0 / rate, self.tick)\n\n"
    "    def tick(self):\n        pass\n"
)
_OTHERS = (
    "from rclpy.node import Node\nfrom std_msgs.msg import String\n\n\n"
    "class Talker(Node):\n    def __init__(self):\n"
    "        topic = self.declare_parameter('topic', 'chatter'){}\n"
    "        if self.get_parameter('topic'){} == 'chatter':\n"
    "            is_loud = not self.get_parameter('topic'){}\n"
    "        self.create_publisher(String, topic, 10 if is_loud else 1)\n"
)


class ParameterObjectUsed(RclpyRule):
    """A Parameter object is used in arithmetic, comparisons or calls instead of its value.

    **Why.** ``TypeError: unsupported operand type(s) for /: 'float' and 'Parameter'``. A condition
    is always true, a comparison with a value never is, and a str shows the address of the object.

    **Fix.** Append ``.value``.

    **Source.** ROS 2 documentation, "Using parameters in a class (Python)".
    """

    code = "ND017"
    name = "parameter-object-used"
    examples = (
        Example("the value", {"talker.py": _NODE.format(".value")}),
        Example(
            "the object",
            {"talker.py": _NODE.format("")},
            Report(
                "8:16",
                "this is the Parameter (used in line 9), not its value; append .value",
                fix="append .value",
            ),
            fixed={"talker.py": _NODE.format(".value")},
        ),
        Example(
            "a condition, a comparison, a name",
            {"talker.py": _OTHERS.format("", "", "")},
            Report(
                "7:17",
                "this is the Parameter (used in line 10), not its value; append .value",
                fix="append .value",
            ),
            Report(
                "8:12", "this is the Parameter, not its value; append .value", fix="append .value"
            ),
            Report(
                "9:27", "this is the Parameter, not its value; append .value", fix="append .value"
            ),
            fixed={"talker.py": _OTHERS.format(".value", ".value", ".value")},
        ),
    )

    def check_file(self, file: RclpyFile) -> Iterator[Diagnostic]:
        for read, use in objects_used(file):
            _, end = file.module.span(read.call)
            fix = Fix("append .value", (Edit(file.module.path, end, end, ".value"),))
            line = file.module.location(use).line
            where = "" if line == read.location.line else f" (used in line {line})"
            message = f"this is the Parameter{where}, not its value; append .value"
            yield self.report(read, message, fix)
