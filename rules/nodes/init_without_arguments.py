"""ND006: rclpy gets the command line."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Edit, Example, Fix, RclpyRule, Report
from scaffold.api.rclpy import RclpyFile

_MAIN = "import rclpy\n\n\ndef main(args=None):\n    rclpy.init({})\n    rclpy.shutdown()\n"


class InitWithoutArguments(RclpyRule):
    """``rclpy.init`` gets an empty list of arguments.

    **Why.** It replaces the command line: ``--ros-args``, with the remappings and parameters of a
    launch file, have no effect.

    **Fix.** Write ``rclpy.init(args=args)``, where ``None`` means the command line.

    **Source.** ROS 2 documentation, "Passing ROS arguments to nodes via the command line".
    """

    code = "ND006"
    name = "init-without-arguments"
    examples = (
        Example("the command line", {"talker.py": _MAIN.format("args=args")}),
        Example(
            "an empty list",
            {"talker.py": _MAIN.format("args=[]")},
            Report(
                "5:21",
                "an empty list replaces the command line: --ros-args have no effect",
                fix="pass the arguments on",
            ),
            fixed={"talker.py": _MAIN.format("args=args")},
        ),
    )

    def check_file(self, file: RclpyFile) -> Iterator[Diagnostic]:
        for call in file.init_calls:
            given = [word.value for word in call.call.keywords if word.arg == "args"]
            given = given or call.call.args[:1]
            if not given or not isinstance(given[0], ast.List | ast.Tuple) or given[0].elts:
                continue
            own = call.function.args.args if call.function else []
            fix = None
            if any(argument.arg == "args" for argument in own):
                edit = Edit(file.module.path, *file.module.span(given[0]), "args")
                fix = Fix("pass the arguments on", (edit,))
            message = "an empty list replaces the command line: --ros-args have no effect"
            yield self.report(file.module.location(given[0]), message, fix)
