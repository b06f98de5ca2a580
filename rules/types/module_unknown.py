"""TY001: imported modules exist."""

from __future__ import annotations

import ast
import re

from scaffold.api import Diagnostic, Edit, Example, Fix, Report, Severity, TypeRule, closest_name
from scaffold.api.distributions import target
from scaffold.api.types import TypeFinding, module_names

_INSTEAD = {
    "asynchat": "asyncio",
    "asyncore": "asyncio",
    "binhex": "base64",
    "cgi": "email.message",
    "crypt": "hashlib",
    "distutils": "shutil, sysconfig or packaging.version",
    "formatter": "string",
    "imp": "importlib",
    "imghdr": "filetype",
    "parser": "ast",
    "pipes": "subprocess",
    "smtpd": "aiosmtpd",
    "sndhdr": "filetype",
    "symbol": "token",
    "telnetlib": "telnetlib3",
}
_NODE = "import rclpy\nimport {}\n\nrclpy.init()\nmessage = std_msgs.msg.String()\n"


class ModuleUnknown(TypeRule):
    """Code imports a module that Python 3.12 or a package of ROS 2 does not have.

    **Why.** The program ends at start: ``ModuleNotFoundError: No module named 'imp'``.

    **Fix.** Import the module that has what you need; classes of messages are imported from
    ``std_msgs.msg``.

    **Source.** Python 3.12, which Jazzy runs on; the packages of ROS 2 Jazzy.
    """

    code = "TY001"
    name = "module-unknown"
    other_severities = {Severity.WARNING: "setuptools may lend the module"}
    is_deprecation = True
    kinds = frozenset({"import-not-found"})
    examples = (
        Example("a module", {"talker.py": _NODE.format("std_msgs.msg")}),
        Example(
            "one that may be missing",
            {"talker.py": "try:\n    import imp\nexcept ImportError:\n    imp = None\n"},
        ),
        Example(
            "a class",
            {"talker.py": _NODE.format("std_msgs.msg.String")},
            Report(
                "2:8",
                "'String' is a class, not a module: ModuleNotFoundError; write "
                "`from std_msgs.msg import String`",
                fix="import 'std_msgs.msg'",
            ),
            fixed={"talker.py": _NODE.format("std_msgs.msg")},
        ),
        Example(
            "modules that Python 3.12 lacks, a misspelled one",
            {"talker.py": "import imp\nfrom distutils import util\nimport rclpy.nodes\n"},
            Report("1:8", "Python 3.12 has no module 'imp': ModuleNotFoundError; use importlib"),
            Report(
                "2:6",
                "Python 3.12 has no module 'distutils': ModuleNotFoundError; use "
                "shutil, sysconfig or packaging.version",
                severity=Severity.WARNING,
            ),
            Report(
                "3:8",
                "ROS 2 Jazzy has no module 'rclpy.nodes': ModuleNotFoundError; did "
                "you mean 'rclpy.node'?",
            ),
        ),
    )

    def judge(self, finding: TypeFinding) -> Diagnostic | None:
        matched = finding.match(r"Cannot resolve imported module `([\w.]+)`")
        if matched is None:
            return None
        module = matched[1]
        root = module.partition(".")[0]
        if root in _INSTEAD:
            severity = Severity.WARNING if root == "distutils" else None
            message = (
                f"Python {target().python_version} has no module {root!r}: ModuleNotFoundError; "
                f"use {_INSTEAD[root]}"
            )
            return self.report(finding, message, severity=severity)
        above, _, last = module.rpartition(".")
        if last.startswith("_"):
            return None  # an extension module
        if re.fullmatch(r"\w+\.(msg|srv|action)\.[A-Z]\w*", module):
            message = (
                f"{last!r} is a class, not a module: ModuleNotFoundError; "
                f"write `from {above} import {last}`"
            )
            return self.report(finding, message, self._fix(finding, module))
        closest = closest_name(finding.package, last, module_names(finding.package, above), 0.6)
        hint = f"; did you mean '{above}.{closest}'?" if closest else ""
        return self.report(
            finding, f"ROS 2 {target().title} has no module {module!r}: ModuleNotFoundError{hint}"
        )

    def _fix(self, finding: TypeFinding, module: str) -> Fix | None:
        """Import the module of the class: the code names it in full."""
        above = module.rpartition(".")[0]
        for alias in finding.module.walk(ast.alias):
            if alias.name != module or alias.asname:
                continue
            start, end = finding.module.span(alias)
            if finding.module.source.location(start, end) == finding.location:
                edit = Edit(finding.path, start + len(above), start + len(module), "")
                return Fix(f"import {above!r}", (edit,))
        return None
