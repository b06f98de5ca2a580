"""ND005: rclpy is initialized once, with the command line, and not in a ``with`` statement."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Edit, Effect, Example, Fix, RclpyRule, Report, Severity
from scaffold.api.distributions import target
from scaffold.api.python import FunctionNode, argument_of
from scaffold.api.rclpy import RclpyCall, RclpyFile, known_names

_MAIN = (
    "import rclpy\n\n\ndef main(args=None):\n    rclpy.init(args=args)\n{}    rclpy.shutdown()\n"
)
_PARSERS = frozenset({"argparse", "click", "docopt", "optparse", "typer"})
"""Modules that read a command line."""
_MAIN_ARGUMENTS = (
    "import rclpy\n\n\ndef main(args=None):\n    rclpy.init({})\n    rclpy.shutdown()\n"
)
_WITH = "import rclpy\n\n\ndef main():\n    with rclpy.init():\n        pass\n"
_PLAIN = "import rclpy\n\n\ndef main():\n    rclpy.init()\n"


class InitMisused(RclpyRule):
    """``rclpy.init()`` is called twice, gets an empty list, or is used as a context manager.

    **Why.** ``RuntimeError: Context.init() must only be called once``. An empty list replaces the
    command line: ``--ros-args``, with the remappings and parameters of a launch file, is ignored.
    On Humble and Jazzy ``init`` returns None: ``TypeError: 'NoneType' object does not support the
    context manager protocol``.

    **Fix.** Keep the first call; write ``rclpy.init(args=args)``, where ``None`` means the command
    line, and ``rclpy.try_shutdown()`` in a ``finally``.

    **Source.** ``rclpy/context.py``; rclpy 7.4.0 (pull request 1298); ROS 2 documentation, "Passing
    ROS arguments to nodes via the command line".
    """

    code = "ND005"
    name = "init-misused"
    effect = Effect.STOPS_START
    other_severities = {
        Severity.WARNING: "the program parses its command line itself, or the function has other "
        "required arguments"
    }
    examples = (
        Example("once", {"talker.py": _MAIN.format("")}),
        Example(
            "again after a shutdown",
            {"talker.py": _MAIN.format("    rclpy.shutdown()\n    rclpy.init()\n")},
        ),
        Example(
            "twice",
            {"talker.py": _MAIN.format("    rclpy.init()\n")},
            "6:5: rclpy.init() is already called in line 5: RuntimeError",
        ),
        Example(
            "in the constructor of a node",
            {
                "talker.py": "from rclpy.node import Node\n"
                + _MAIN.format("    Talker()\n")
                + "\n\nclass Talker(Node):\n"
                "    def __init__(self):\n"
                "        rclpy.init()\n"
                "        super().__init__('talker')\n"
            },
            "13:9: rclpy.init() is called before this node is constructed: RuntimeError",
        ),
        Example("the command line", {"talker.py": _MAIN_ARGUMENTS.format("args=args")}),
        Example(
            "a separate context",
            {"talker.py": _MAIN_ARGUMENTS.format("args=[], context=rclpy.Context()")},
        ),
        Example(
            "an empty list instead of the command line",
            {"talker.py": _MAIN_ARGUMENTS.format("args=[]")},
            Report(
                "5:21",
                "an empty list replaces the command line: --ros-args is ignored; pass args",
                fix="Pass the arguments",
            ),
            fixed={"talker.py": _MAIN_ARGUMENTS.format("args=args")},
        ),
        Example(
            "an empty list, in a program with its own options",
            {
                "talker.py": f"import argparse\n{_MAIN_ARGUMENTS.format('[]')}".replace(
                    "args=None", ""
                )
            },
            Report(
                "6:16",
                "an empty list replaces the command line: --ros-args is ignored; pass args",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "an empty list, in a function with other required arguments",
            {
                "talker.py": _MAIN_ARGUMENTS.format("args=[]").replace(
                    "args=None", "configuration, queue"
                )
            },
            Report(
                "5:21",
                "an empty list replaces the command line: --ros-args is ignored; pass args",
                severity=Severity.WARNING,
            ),
        ),
        Example("a plain call", {"talker.py": _PLAIN}),
        Example(
            "a with statement",
            {"talker.py": _WITH},
            "5:10: rclpy.init() is not a context manager on Jazzy: TypeError at start",
        ),
    )

    def check_file(self, file: RclpyFile) -> Iterator[Diagnostic]:
        yield from self._check_again(file)
        yield from self._check_arguments(file)
        if "rclpy.InitContextManager" not in known_names():
            title = target().title
            for call in file.init_calls:
                if call.in_with:
                    message = "rclpy.init() is not a context manager on"
                    yield self.report(call, f"{message} {title}: TypeError at start")

    def _check_again(self, file: RclpyFile) -> Iterator[Diagnostic]:
        started: RclpyCall | None = None
        calls = sorted((*file.init_calls, *file.shutdown_calls), key=lambda call: call.location)
        for call in calls:
            in_node = call.name == "init" and self._is_in_node(file, call)
            if in_node and any(not self._is_in_node(file, x) for x in file.init_calls):
                message = "rclpy.init() is called before this node is constructed: RuntimeError"
                yield self.report(call, message)
                continue
            if call.name != "init":
                started = None
                continue
            if self._has_own_context(call) or file.is_conditional(call.call):
                started = None
                continue
            if started is not None and started.function is call.function:
                line = started.location.line
                yield self.report(
                    call, f"rclpy.init() is already called in line {line}: RuntimeError"
                )
            started = call

    def _is_in_node(self, file: RclpyFile, call: RclpyCall) -> bool:
        """Return whether a method of a node class contains the call, so that the node exists."""
        class_ = file.module.enclosing_class(call.call)
        return class_ is not None and file.node_class(class_) is not None

    def _has_own_context(self, call: RclpyCall) -> bool:
        return any(word.arg in {"context", None} for word in call.call.keywords)

    def _check_arguments(self, file: RclpyFile) -> Iterator[Diagnostic]:
        for call in file.init_calls:
            given = argument_of(call.call, "args", 0)
            if not isinstance(given, ast.List | ast.Tuple) or given.elts:
                continue
            if argument_of(call.call, "context") is not None:
                continue
            own = call.function.args.args if call.function else []
            fix = None
            if any(argument.arg == "args" for argument in own):
                edit = Edit(file.module.path, *file.module.span(given), "args")
                fix = Fix("Pass the arguments", (edit,))
            message = "an empty list replaces the command line: --ros-args is ignored; pass args"
            is_meant = any(
                item.module.partition(".")[0] in _PARSERS for item in file.module.imports
            )
            is_given = call.function is not None and _is_given_more(call.function)
            severity = Severity.WARNING if is_meant or is_given else Severity.ERROR
            yield self.report(file.module.location(given), message, fix, severity=severity)


def _is_given_more(function: FunctionNode) -> bool:
    """Return whether a function needs further arguments, so that it is not an entry point."""
    arguments = function.args
    names = [item.arg for item in (*arguments.posonlyargs, *arguments.args)]
    required = names[: len(names) - len(arguments.defaults)]
    return not {*required} <= {"self", "cls", "args", "argv"}
