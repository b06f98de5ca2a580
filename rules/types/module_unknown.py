"""TY001: imported modules exist."""

from __future__ import annotations

import ast
import re
from collections.abc import Sequence

from scaffold.api import (
    Diagnostic,
    Edit,
    Effect,
    Example,
    Fix,
    Report,
    Severity,
    TypeRule,
    closest_name,
)
from scaffold.api.distributions import target
from scaffold.api.install import is_installed_by_path
from scaffold.api.types import TypeFinding, later_modules, module_names, modules_with

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
_BEFORE = {
    "compression.zstd": "backports.zstd",
    "tomllib": "tomli",
}
"""Replacements with the same functions for earlier Pythons."""
_INTERFACES = {
    "package.xml": '<package format="3"><name>talker</name>'
    "<export><build_type>ament_cmake</build_type></export></package>\n",
    "CMakeLists.txt": "project(talker)\nfind_package(ament_cmake_python REQUIRED)\n"
    'rosidl_generate_interfaces(${PROJECT_NAME} "msg/Beat.msg")\n'
    "install(DIRECTORY scripts/ DESTINATION ${PYTHON_INSTALL_DIR}/${PROJECT_NAME}\n"
    '  FILES_MATCHING PATTERN "*.py")\n'
    "install(PROGRAMS scripts/node.py DESTINATION lib/${PROJECT_NAME})\nament_package()\n",
    "msg/Beat.msg": "int32 count\n",
}
_NODE = "import rclpy\nimport {}\n\nrclpy.init()\nmessage = std_msgs.msg.String()\n"


class ModuleUnknown(TypeRule):
    """Code imports a module that Python or a package of ROS 2 does not have.

    **Why.** The program fails at start: ``ModuleNotFoundError: No module named 'imp'``.

    **Fix.** Correct the name, or use a replacement such as ``importlib``. Import message classes
    from their module: ``from std_msgs.msg import String``.

    **Source.** The standard library of the distribution's Python, 3.12 for Jazzy; its ROS 2
    packages.
    """

    code = "TY001"
    name = "module-unknown"
    effect = Effect.STOPS_START
    other_severities = {Severity.WARNING: "it is ``distutils``, which setuptools may provide"}
    is_removal = True
    kinds = frozenset({"import-not-found"})
    examples = (
        Example(
            "module of an extension module",
            {"talk.py": "from rclpy._rclpy_pybind11.service_introspection import *\n"},
        ),
        Example("existing module", {"talker.py": _NODE.format("std_msgs.msg")}),
        Example(
            "optional import with except ImportError",
            {"talker.py": "try:\n    import imp\nexcept ImportError:\n    imp = None\n"},
        ),
        Example(
            "setup.py of an ament_cmake package, which is never run",
            {
                "package.xml": "<package><name>talker</name>"
                "<export><build_type>ament_cmake</build_type></export></package>\n",
                "setup.py": "from distutils.core import setup\n\nsetup()\n",
            },
        ),
        Example(
            "message class imported as a module",
            {"talker.py": _NODE.format("std_msgs.msg.String")},
            Report(
                "2:8",
                "'String' is a class, not a module: ModuleNotFoundError; write `from "
                "std_msgs.msg import String`",
                fix="Import 'std_msgs.msg'",
            ),
            fixed={"talker.py": _NODE.format("std_msgs.msg")},
        ),
        Example(
            "modules removed in Python 3.12, misspelled modules",
            {
                "talker.py": "import imp\nfrom distutils import util\nimport rclpy.nodes\n"
                "from std_msgs.srv import SetBool\n"
            },
            "1:8: Python 3.12 has no module 'imp': ModuleNotFoundError; use importlib",
            Report(
                "2:6",
                "Python 3.12 has no module 'distutils': ModuleNotFoundError; use "
                "shutil, sysconfig or packaging.version",
                severity=Severity.WARNING,
            ),
            "3:8: ROS 2 Jazzy has no module 'rclpy.nodes': ModuleNotFoundError; did you mean "
            "'rclpy.node'?",
            "4:6: ROS 2 Jazzy has no module 'std_msgs.srv': ModuleNotFoundError; did you mean "
            "'example_interfaces.srv' or 'std_srvs.srv'?",
        ),
        Example(
            "module that only a newer Python version has",
            {"settings.py": "import tomllib\n"},
            "1:8: Python 3.10 has no module 'tomllib', which is new in 3.11: ModuleNotFoundError; "
            "use tomli",
            distro="humble",
        ),
        Example(
            "module that this Python version has",
            {"settings.py": "import tomllib\n"},
        ),
        Example(
            "submodule of a package that only a newer Python version has",
            {"archive.py": "from compression import zstd\n"},
            "1:6: Python 3.12 has no module 'compression.zstd', which is new in 3.14: "
            "ModuleNotFoundError; use backports.zstd",
        ),
        Example(
            "imports with a check of the Python version",
            {
                "settings.py": "import sys\n\nif sys.version_info >= (3, 11):\n"
                "    import tomllib\nelse:\n    import tomli as tomllib\n",
                "loader.py": "try:\n    import tomllib\nexcept ModuleNotFoundError:\n"
                "    import tomli as tomllib\n",
            },
            distro="humble",
        ),
        Example(
            "imports with a check of the Python version from another library",
            {
                "loader.py": "import rclpy\nfrom six import PY3\nfrom torch._six import PY37\n\n"
                "if PY37:\n    import importlib\nelse:\n    import imp\n"
                "if not PY3:\n    import asyncore\nrclpy.init()\n",
            },
        ),
        Example(
            "module that CMake installs into the generated message package",
            {
                **_INTERFACES,
                "scripts/node.py": "from talker.gains import Gains\nfrom talker.msg import Beat\n"
                "from talker import gains\n",
                "scripts/gains.py": "",
            },
        ),
        Example(
            "module that CMake does not install",
            {
                **_INTERFACES,
                "scripts/node.py": "from talker.limits import Limits\n"
                "from talker.msg import Beat\n",
            },
            "scripts/node.py:1:6: ROS 2 Jazzy has no module 'talker.limits': ModuleNotFoundError",
        ),
        Example(
            "other package with the name of a newer standard library module",
            {"archive.py": "import rclpy\nfrom compression import pack\n\nrclpy.init()\npack()\n"},
        ),
    )

    def judge(self, finding: TypeFinding) -> Diagnostic | None:
        matched = finding.match(r"Cannot resolve imported module `([\w.]+)`")
        is_run = finding.path != "setup.py" or finding.package.build_type != "ament_cmake"
        if matched is None or not is_run or is_installed_by_path(finding.package, matched[1]):
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
        later = later_modules()
        if module in later or any(name.startswith(f"{module}.") for name in later):
            return self._of_later_python(finding, module)
        above, _, last = module.rpartition(".")
        if "._" in module:
            return None  # an extension module, or one inside of it
        if re.fullmatch(r"\w+\.(msg|srv|action)\.[A-Z]\w*", module):
            message = (
                f"{last!r} is a class, not a module: ModuleNotFoundError; "
                f"write `from {above} import {last}`"
            )
            return self.report(finding, message, self._fix(finding, module))
        closest = closest_name(finding.package, last, module_names(finding.package, above), 0.6)
        likely = _with_names(finding, module)
        if closest:
            likely = [f"{above}.{closest}"]
        hint = f"; did you mean {' or '.join(map(repr, likely))}?" if likely else ""
        return self.report(
            finding, f"ROS 2 {target().title} has no module {module!r}: ModuleNotFoundError{hint}"
        )

    def _of_later_python(self, finding: TypeFinding, module: str) -> Diagnostic | None:
        """Report a module that Python does not have yet, or one imported from its package."""
        later = later_modules()
        names = [f"{module}.{name}" for name in _imported(finding, module)]
        new = next((name for name in (module, *names) if name in later), None)
        if new is None:
            return None  # a package of the user with the name of a Python module
        use = f"; use {_BEFORE[new]}" if new in _BEFORE else ""
        message = (
            f"Python {target().python_version} has no module {new!r}, which is new in "
            f"{later[new]}: ModuleNotFoundError{use}"
        )
        return self.report(finding, message)

    def _fix(self, finding: TypeFinding, module: str) -> Fix | None:
        """Import the module of the class: the code names it in full."""
        above = module.rpartition(".")[0]
        for alias in finding.module.walk(ast.alias):
            if alias.name != module or alias.asname:
                continue
            start, end = finding.module.span(alias)
            if finding.module.source.location(start, end) == finding.location:
                edit = Edit(finding.path, start + len(above), start + len(module), "")
                return Fix(f"Import {above!r}", (edit,))
        return None


def _imported(finding: TypeFinding, module: str) -> Sequence[str]:
    """Return the names that the reported line imports from a module."""
    return [
        alias.name
        for node in finding.module.walk(ast.ImportFrom)
        if node.module == module and node.lineno == finding.location.line
        for alias in node.names
    ]


def _with_names(finding: TypeFinding, module: str) -> Sequence[str]:
    """Return the modules that have all names imported from a missing one."""
    having = [{*modules_with(finding.package, name, module)} for name in _imported(finding, module)]
    return sorted(frozenset.intersection(*map(frozenset, having))) if having else []
