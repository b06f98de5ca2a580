"""Processing of messages in generated nodes, and whether generated tests detect errors in it."""

# ruff: noqa: S102  messages of rclpy have no types, and the code is what is tested

from __future__ import annotations

import ast
import re
from collections.abc import Iterator, Sequence
from importlib.util import find_spec
from textwrap import indent
from typing import Any

import pytest

from scaffold.generate import payload
from scaffold.generate.payload import Payload
from scaffold.generate.payload.processing import PROCESSES, Process
from tests.generate.payload.test_payload import Node, need_installed, round_trip

pytestmark = [
    pytest.mark.filterwarnings("ignore:module 'sre_:DeprecationWarning"),  # of lark
    pytest.mark.skipif(
        find_spec("rclpy") is None, reason="no ROS 2: install the extra 'ros' of this project"
    ),
]
COUNT = 60
"""As many messages as a generated test looks at."""
START = 1_700_000_000
"""The time of the first of them, in seconds: what many messages say follows the clock."""
ERRORS = (
    (r"\bmin\(", "max("),
    (r"\bmax\(", "min("),
    (r"\bsin\(", "cos("),
    (r" \+ ", " - "),
    (r" - ", " + "),
    (r" -= ", " += "),
    (r" < ", " > "),
    (r" <= ", " >= "),
    (r" / ", " * "),
    (r"\bx\b", "y"),
    (r"\by\b", "z"),
    (r"^( *)(\w\S* = .*)", r"\1pass"),
    (r"\b(?!0\.0\b)(\d+\.\d+)", r"2.0 * \1"),
    (r"\bif (?!not )", "if not "),
    (r"axes\[1\]", "axes[0]"),
    (r"linear\b", "angular"),
)
"""What somebody who changes the code could get wrong, in one place."""


class TimedNode(Node):
    """A node with a deterministic clock that advances one second per message."""

    def get_clock(self) -> TimedNode:
        return self

    def now(self) -> object:
        from rclpy.time import Time

        return Time(seconds=START + self.count)


def source(line: str, head: str, lines: Sequence[str], result: str) -> str:
    """Return the source of a function below a line of its module."""
    return f"{line}\ndef {head}:\n{indent(chr(10).join(lines), '    ')}\n    return {result}\n"


def run(
    received: Payload, published: Payload, process: Process, constant: str, lines: Sequence[str]
) -> bool:
    """Return whether all published messages pass the check of the generated test."""
    names: dict[str, Any] = {"pytest": pytest}
    imports = [*received.imports, *published.imports, "import math"]
    exec("\n".join([*imports, *received.constants, *published.constants]), names)
    sent = [f"msg = {received.name}()", *received.statements, *process.sent_lines]
    exec(source("", "send(self)", sent, "msg"), names)
    is_same = received.type == published.type
    start = "msg = received" if is_same else f"msg = {published.name}()"
    exec(source(constant, "process(self, received)", [start, *lines], "msg"), names)
    exec(source("", "is_right(message, item)", [f"return {process.expected}"], "None"), names)
    node, results = TimedNode(), []
    for node.count in range(COUNT):
        item = round_trip(names["send"](node))
        message = round_trip(names["process"](node, round_trip(item)))
        results.append(names["is_right"](message, item))
    return all(results)


def mutants(process: Process) -> Iterator[tuple[str, list[str]]]:
    """Yield the constant and the code of a process with one mutated line."""
    lines = [process.constant, *process.lines]
    for at, line in enumerate(lines):
        changed = {re.sub(old, new, line, count=1) for old, new in ERRORS} - {line}
        for other in sorted(changed):
            broken = [*lines[:at], other, *lines[at + 1 :]]
            try:
                unchanged = ast.dump(ast.parse("\n".join(broken))) == ast.dump(
                    ast.parse("\n".join(lines))
                )
            except SyntaxError:
                continue
            if not unchanged:
                yield broken[0], broken[1:]


@pytest.mark.parametrize(("received", "published"), sorted(PROCESSES))
def test_check_accepts_the_process_and_rejects_mutants(received: str, published: str) -> None:
    item, message = payload.payload(received), payload.payload(published)
    need_installed({*item.packages, *message.packages})
    process = item.processed(message)
    assert process is not None
    assert run(item, message, process, process.constant, process.lines)
    for constant, lines in mutants(process):
        try:
            is_accepted = run(item, message, process, constant, lines)
        except Exception:  # noqa: BLE001, S112  a node that ends is seen by every test
            continue
        assert not is_accepted, [constant, *lines]
