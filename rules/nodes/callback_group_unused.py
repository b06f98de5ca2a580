"""ND123: callback groups are used."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, RclpyRule, Report, Severity
from scaffold.api.rclpy import RclpyFile, is_used_elsewhere

_GROUPS = frozenset(
    f"rclpy.callback_groups.{kind}CallbackGroup" for kind in ("Reentrant", "MutuallyExclusive")
)
_NODE = (
    "from rclpy.callback_groups import ReentrantCallbackGroup\nfrom rclpy.node import Node\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "        self.group = ReentrantCallbackGroup()\n"
    "        self.create_timer(1.0, self.tick{})\n\n"
    "    def tick(self):\n"
    "        pass\n"
)


class CallbackGroupUnused(RclpyRule):
    """A callback group is made and given to nothing.

    **Why.** All callbacks stay in the default group of the node, which runs one at a time, with
    any executor: what was to run side by side waits, or deadlocks.

    **Fix.** ``self.create_timer(1.0, self.tick, callback_group=self.group)``.

    **Source.** ROS 2 documentation, "Using callback groups".
    """

    code = "ND123"
    name = "callback-group-unused"
    severity = Severity.WARNING
    examples = (
        Example("used", {"talker.py": _NODE.format(", callback_group=self.group")}),
        Example(
            "unused",
            {"talker.py": _NODE.format("")},
            Report(
                "8:22",
                "callback group 'group' is given to nothing: all callbacks run one "
                "at a time; pass callback_group=",
            ),
        ),
    )

    def check_in(self, package: Package, file: RclpyFile) -> Iterator[Diagnostic]:
        if not file.module.mentions("CallbackGroup(") or file.module.in_tests:
            return
        for call in file.module.walk(ast.Call):
            if _GROUPS.isdisjoint(file.module.qualified_names(call.func)):
                continue
            attribute, variable = file.stored_in(call)
            uses: list[ast.Attribute | ast.Name] = []
            if attribute:
                uses += file.module.index.attributes(attribute)
            elif variable:
                uses += file.module.index.names(variable)
            else:
                continue
            if any(isinstance(use.ctx, ast.Load) for use in uses):
                continue
            if attribute and is_used_elsewhere(package, file, attribute):
                continue
            message = (
                f"callback group {attribute or variable!r} is given to nothing: all callbacks run "
                "one at a time; pass callback_group="
            )
            yield self.report(file.module.location(call), message)
