"""IM051: names are used that will stay."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Fix, PythonRule, Report, Severity
from scaffold.api.distributions import of_kind
from scaffold.api.python import PythonModule
from scaffold.api.rclpy import changed_uses

_NODE = (
    "import rclpy\nfrom rclpy.node import Node\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "        self.get_logger().{}('hello')\n"
)


class NameDeprecated(PythonRule):
    """Code uses a name that is deprecated in the distribution.

    **Why.** It works, with a warning at most; a later distribution removes it.

    **Fix.** Use its replacement.

    **Source.** The pull requests that ``scaffold/data/changes.toml`` names.
    """

    code = "IM051"
    name = "name-deprecated"
    is_fixed_for_all = True
    is_deprecation = True
    severity = Severity.INFO
    examples = (
        Example("the new name", {"talker.py": _NODE.format("warning")}, distro="kilted"),
        Example(
            "the old name",
            {"talker.py": _NODE.format("warn")},
            Report(
                "8:9",
                "rclpy.impl.rcutils_logger.RcutilsLogger.warn is deprecated "
                "since Kilted, and Lyrical removes it; use warning (rclpy 1456)",
                fix="write warning",
            ),
            fixed={"talker.py": _NODE.format("warning")},
            distro="kilted",
        ),
    )

    def check_file(self, module: PythonModule) -> Iterator[Diagnostic]:
        changes = [change for change in of_kind("name") if change.is_deprecated]
        for use in changed_uses(module, changes):
            message = f"{use.shown} {use.change.state}; {use.change.instead(use.replacement)} "
            message += f"({use.change.source})"
            fix = Fix(f"write {use.replacement}", use.edits) if use.edits else None
            yield self.report(use.location, message, fix)
