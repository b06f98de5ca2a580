"""ND006: rclpy gets the command line."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Edit, Example, Fix, RclpyRule, Report, Severity
from scaffold.api.python import FunctionNode
from scaffold.api.rclpy import RclpyFile

_PARSERS = frozenset({"argparse", "click", "docopt", "optparse", "typer"})
"""Modules that read a command line."""
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
    other_severities = {
        Severity.WARNING: "the program reads its command line itself, or its caller decides: "
        "the function has other required arguments"
    }
    examples = (
        Example("the command line", {"talker.py": _MAIN.format("args=args")}),
        Example(
            "a context of its own, next to the one of the program",
            {"talker.py": _MAIN.format("args=[], context=rclpy.Context()")},
        ),
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
        Example(
            "an empty list, for a program with options of its own",
            {"talker.py": f"import argparse\n{_MAIN.format('[]')}".replace("args=None", "")},
            Report(
                "6:16",
                "an empty list replaces the command line: --ros-args have no effect",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "an empty list, for a process that gets all it needs from another",
            {"talker.py": _MAIN.format("args=[]").replace("args=None", "configuration, queue")},
            Report(
                "5:21",
                "an empty list replaces the command line: --ros-args have no effect",
                severity=Severity.WARNING,
            ),
        ),
    )

    def check_file(self, file: RclpyFile) -> Iterator[Diagnostic]:
        for call in file.init_calls:
            given = [word.value for word in call.call.keywords if word.arg == "args"]
            given = given or call.call.args[:1]
            if not given or not isinstance(given[0], ast.List | ast.Tuple) or given[0].elts:
                continue
            if any(word.arg == "context" for word in call.call.keywords):
                continue
            own = call.function.args.args if call.function else []
            fix = None
            if any(argument.arg == "args" for argument in own):
                edit = Edit(file.module.path, *file.module.span(given[0]), "args")
                fix = Fix("pass the arguments on", (edit,))
            message = "an empty list replaces the command line: --ros-args have no effect"
            is_meant = any(
                item.module.partition(".")[0] in _PARSERS for item in file.module.imports
            )
            is_given = call.function is not None and _is_given_more(call.function)
            severity = Severity.WARNING if is_meant or is_given else Severity.ERROR
            yield self.report(file.module.location(given[0]), message, fix, severity=severity)


def _is_given_more(function: FunctionNode) -> bool:
    """Tell whether a function needs more than the command line, so that no program starts in it."""
    arguments = function.args
    names = [item.arg for item in (*arguments.posonlyargs, *arguments.args)]
    required = names[: len(names) - len(arguments.defaults)]
    return not {*required} <= {"self", "cls", "args", "argv"}
