"""ND072: nodes look up packages that exist."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, RclpyRule
from scaffold.api.launch import Reference, meant_package
from scaffold.api.manifest import name_used_elsewhere
from scaffold.api.python import is_handled
from scaffold.api.rclpy import RclpyFile

_FUNCTIONS = frozenset(
    f"ament_index_python{module}.{function}"
    for module in ("", ".packages")
    for function in ("get_package_share_directory", "get_package_prefix", "get_package_share_path")
)
_NODE = (
    "import os\n\nfrom ament_index_python.packages import get_package_share_directory\n"
    "import rclpy\n\n\n"
    "def words():\n"
    "    return os.path.join(get_package_share_directory('{}'), 'words.txt')\n"
)
_MANIFEST = "<package format='3'><name>talker_py</name></package>\n"


class ShareOfMisspelledPackage(RclpyRule):
    """A node looks up the share directory of a package whose name is misspelled.

    **Why.** ``PackageNotFoundError: "package 'taker_py' not found"`` when the line is executed.

    **Fix.** Use the name in its package.xml.

    **Source.** ``ament_index_python/packages.py``, ``get_package_prefix``.
    """

    code = "ND072"
    name = "share-of-misspelled-package"
    examples = (
        Example(
            "this package",
            {"package.xml": _MANIFEST, "talker_py/node.py": _NODE.format("talker_py")},
        ),
        Example(
            "an unknown package",
            {"package.xml": _MANIFEST, "talker_py/node.py": _NODE.format("robot_words")},
        ),
        Example(
            "a missing letter",
            {"package.xml": _MANIFEST, "talker_py/node.py": _NODE.format("taker_py")},
            "talker_py/node.py:8:53: no package 'taker_py': PackageNotFoundError; did you mean "
            "'talker_py' (this package)?",
        ),
    )

    def check_in(self, package: Package, file: RclpyFile) -> Iterator[Diagnostic]:
        for call in file.module.calls_of(*_FUNCTIONS):
            if not call.args:
                continue
            name = file.evaluator.evaluate(call.args[0])
            if not isinstance(name, str) or name == name_used_elsewhere(package):
                continue
            at = file.module.location(call.args[0])
            closest = meant_package(package, Reference(name, at, None, at))
            if closest is not None and not is_handled(file.module, call, "PackageNotFoundError"):
                message = (
                    f"no package {name!r}: PackageNotFoundError; did you mean "
                    f"{closest.name!r} ({closest.reason})?"
                )
                yield self.report(at, message)
