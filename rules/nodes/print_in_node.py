"""ND036: nodes log."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, RclpyRule, Report, Severity
from scaffold.api.rclpy import RclpyFile

_TERMINAL = frozenset({"argparse", "click", "cmd", "curses", "getpass", "msvcrt", "optparse"})
_TERMINAL |= {"readline", "termios", "tty", "typer"}
"""Who imports these talks to somebody at a terminal, and printing is the way to do that."""
_NODE = (
    "from rclpy.node import Node\n\n\n"
    "class Talker(Node):\n"
    "    def tick(self):\n"
    "        {}('tick')\n"
)


class PrintInNode(RclpyRule):
    """A node prints, and does not log.

    Programs that read arguments or keys of a terminal may well print.

    **Why.** Under ``ros2 launch`` the output is held back in a buffer, so nothing is seen while
    the node runs; it has no time, no name and no severity, and never gets to ``/rosout``.

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
            reports=(Report("talker.py:6:9", "Talker prints instead of logging"),),
        ),
        Example(
            "a tool for the command line",
            {"talker.py": "import argparse\n" + _NODE.format("print")},
        ),
    )

    def check_file(self, facts: RclpyFile) -> Iterator[Diagnostic]:
        if _is_at_terminal(facts):
            return
        for node in facts.classes:
            found = [
                call
                for method in node.methods.values()
                for call in facts.calls_in(method)
                if isinstance(call.func, ast.Name)
                and call.func.id == "print"
                and not any(word.arg in {"file", "flush"} for word in call.keywords)
                and facts.module.index.lookup("print", call.func) is None
            ]
            if found:
                more = f": {len(found)} times, first here" if len(found) > 1 else ""
                at = facts.module.location(found[0])
                yield self.report(at, f"{node.name} prints instead of logging{more}")


def _is_at_terminal(facts: RclpyFile) -> bool:
    """Tell whether a program has a user who types."""
    index = facts.module.index
    reads = index.names("input") or index.attributes("stdin")
    return bool(reads) or not _TERMINAL.isdisjoint(facts.module.imports_by_root)
