"""ND036: nodes log instead of printing."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, RclpyRule, Severity
from scaffold.api.rclpy import RclpyFile

_TERMINAL = frozenset({"argparse", "click", "cmd", "curses", "getpass", "msvcrt", "optparse"})
_TERMINAL |= {"readline", "termios", "tty", "typer"}
"""Programs that import these interact with a terminal, where printing is fine."""
_NODE = (
    "from rclpy.node import Node\n\n\n"
    "class Talker(Node):\n"
    "    def tick(self):\n"
    "        {}('tick')\n"
)


class PrintInNode(RclpyRule):
    """A node prints instead of logging.

    Programs that read arguments or keys from the terminal may print.

    **Why.** Under ``ros2 launch``, the output is buffered and does not appear while the node runs.
    It has no time, name and severity, and is not published on ``/rosout``.

    **Fix.** Use ``self.get_logger().info(...)``.

    **Source.** launch issue 188; ROS 2 documentation, "Logging".
    """

    code = "ND036"
    name = "print-in-node"
    severity = Severity.INFO
    examples = (
        Example("a log", {"talker.py": _NODE.format("self.get_logger().info")}),
        Example(
            "a print",
            {"talker.py": _NODE.format("print")},
            "6:9: Talker prints: the output is not on /rosout; use get_logger()",
        ),
        Example("a command line tool", {"talker.py": "import argparse\n" + _NODE.format("print")}),
        Example(
            "several prints",
            {"talker.py": _NODE.format("print") + "        print('tock')\n"},
            "6:9: Talker prints (2 times, first here): the output is not on /rosout; use "
            "get_logger()",
        ),
    )

    def check_file(self, file: RclpyFile) -> Iterator[Diagnostic]:
        if _is_at_terminal(file):
            return
        for node in file.classes:
            calls = [
                call
                for method in node.methods.values()
                for call in file.calls_in(method)
                if isinstance(call.func, ast.Name)
                and call.func.id == "print"
                and not any(word.arg in {"file", "flush"} for word in call.keywords)
                and file.module.index.lookup("print", call.func) is None
            ]
            if calls:
                more = f" ({len(calls)} times, first here)" if len(calls) > 1 else ""
                message = (
                    f"{node.name} prints{more}: the output is not on /rosout; use get_logger()"
                )
                yield self.report(file.module.location(calls[0]), message)


def _is_at_terminal(file: RclpyFile) -> bool:
    """Return whether a program interacts with a user at a terminal."""
    index = file.module.index
    reads = index.names("input") or index.attributes("stdin")
    return bool(reads) or not _TERMINAL.isdisjoint(file.module.imports_by_root)
