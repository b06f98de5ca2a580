"""TY002: names imported from modules exist."""

from __future__ import annotations

import ast
import collections.abc
import sys

from scaffold.api import Diagnostic, Edit, Example, Fix, Report, TypeRule, closest_name
from scaffold.api.types import TypeFinding, module_names

_IMPORTED = frozenset({*sys.stdlib_module_names, "launch", "launch_ros", "rclpy", "yaml"})
"""What modules of ROS import for themselves, which their annotations alone do not show."""


class NameNotInModule(TypeRule):
    """Code imports a name from a module that does not have it.

    **Why.** The program ends at start: ``ImportError: cannot import name 'Iterable' from
    'collections'``.

    **Fix.** Import a name that the module of ROS 2 Jazzy, or of Python 3.12, defines.

    **Source.** Python 3.12, which Jazzy runs on; the packages of ROS 2 Jazzy.
    """

    code = "TY002"
    name = "name-not-in-module"
    kinds = frozenset({"missing-module-member"})
    examples = (
        Example(
            "a name that this Python has, in a file without ROS",
            {"clock.py": "from datetime import UTC\n"},
        ),
        Example(
            "a name that Python has later, in a file without ROS",
            {"clock.py": "from datetime import UTC\n"},
            Report("1:22", "'datetime' has no 'UTC': ImportError"),
            distro="humble",
        ),
        Example(
            "names that exist",
            {
                "talker.py": "from rclpy.node import Node\n"
                "from tf2_ros import Buffer, TransformableObject\n"
            },
        ),
        Example(
            "what a module imports for itself",
            {
                "talker.py": "from rclpy.executors import time\n"
                "from launch_ros.substitutions.find_package import get_package_share_directory\n\n"
                "print(time.time(), get_package_share_directory('rclpy'))\n"
            },
        ),
        Example(
            "a moved name",
            {"talker.py": "from collections import Iterable\n"},
            Report(
                "1:25",
                "'collections' has no 'Iterable': ImportError; it is in 'collections.abc'",
                fix="import from 'collections.abc'",
            ),
            fixed={"talker.py": "from collections.abc import Iterable\n"},
        ),
        Example(
            "a misspelled name",
            {"talker.py": "from rclpy.node import Nod\n"},
            Report("1:24", "'rclpy.node' has no 'Nod': ImportError; did you mean 'Node'?"),
        ),
    )

    def judge(self, finding: TypeFinding) -> Diagnostic | None:
        matched = finding.match(r"Module `([\w.]+)` has no member `(\w+)`")
        if matched is None:
            return None
        module, name = matched.groups()
        if module.split(".")[-1].startswith("_") or name.startswith("_"):
            return None
        if name in _IMPORTED:
            return None
        message = f"{module!r} has no {name!r}: ImportError"
        if module == "collections" and name in collections.abc.__all__:
            fix = self._fix(finding)
            return self.report(finding, f"{message}; it is in 'collections.abc'", fix)
        closest = closest_name(finding.package, name, module_names(finding.package, module), 0.6)
        hint = f"; did you mean {closest!r}?" if closest else ""
        return self.report(finding, f"{message}{hint}")

    def _fix(self, finding: TypeFinding) -> Fix | None:
        for node in finding.module.walk(ast.ImportFrom):
            at = finding.module.location(node)
            if at.line != finding.location.line or node.module != "collections":
                continue
            if all(alias.name in collections.abc.__all__ for alias in node.names):
                start, _ = finding.module.span(node)
                start = finding.module.source.text.index("collections", start)
                edit = Edit(finding.path, start, start + len("collections"), "collections.abc")
                return Fix("import from 'collections.abc'", (edit,))
        return None
