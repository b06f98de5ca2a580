"""ND012: names of rclpy are imported from their modules."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, PythonRule, Report
from scaffold.api.python import PythonModule
from scaffold.api.rclpy import PLACES


class ImportFromRclpy(PythonRule):
    """A name is imported from rclpy instead of from its module.

    **Why.** ``ImportError: cannot import name 'Node' from 'rclpy'`` at start.

    **Fix.** Import it from its module: ``from rclpy.node import Node``.

    **Source.** ``rclpy/__init__.py``.
    """

    code = "ND012"
    name = "import-from-rclpy"
    examples = (
        Example("from its module", {"talker.py": "from rclpy.node import Node\n"}),
        Example(
            "from the package",
            {"talker.py": "from rclpy import Node\n"},
            Report("1:19", "rclpy has no 'Node': ImportError; import it from rclpy.node"),
        ),
    )

    def check_file(self, module: PythonModule) -> Iterator[Diagnostic]:
        for statement in module.imports_by_root.get("rclpy", ()):
            if statement.module != "rclpy":
                continue
            for name in statement.names:
                place = PLACES.get(name.name)
                if place is not None:
                    message = f"rclpy has no {name.name!r}: ImportError; import it from {place}"
                    yield self.report(name, message)
