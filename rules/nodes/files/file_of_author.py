"""ND063: nodes read installed files, not files on the author's machine."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, RclpyRule, Severity
from scaffold.api.python import PathValue, argument_of
from scaffold.api.rclpy import RclpyFile

_READERS = frozenset(
    {"open", "io.open", "pathlib.Path", "cv2.imread", "numpy.load", "numpy.loadtxt"}
    | {"pandas.read_csv", "os.listdir", "os.chdir", "os.path.join"}
)
_HOME = r"/(home|Users)/[a-z][\w.-]*/.+"
_NODE = "import rclpy\n\n\ndef words():\n    with open({}) as file:\n        return file.read()\n"


class FileOfAuthor(RclpyRule):
    """A node opens a file in a home directory, or a file of its package by a relative path.

    **Why.** ``FileNotFoundError`` on every other machine; a relative path is relative to the
    directory in which ``ros2 run`` is called.

    **Fix.** Install the file, and open it from
    ``get_package_share_directory('<package>')``.

    **Source.** ROS 2 documentation, "Using ament_index_python"; ``ament_index_python/packages.py``.
    """

    code = "ND063"
    name = "file-of-author"
    severity = Severity.WARNING
    release_refused = "the file is not in the package"
    examples = (
        Example("a parameter", {"talker.py": _NODE.format("get('path')")}),
        Example(
            "in a home directory",
            {"talker.py": _NODE.format("'/home/dev/ws/words.txt'")},
            "5:15: '/home/dev/ws/words.txt' exists only on the author's machine; install the "
            "file, and use get_package_share_directory()",
        ),
        Example(
            "a relative path",
            {"talker.py": _NODE.format("'config/words.txt'"), "config/words.txt": ""},
            "talker.py:5:15: 'config/words.txt' is relative to the current directory, not to the "
            "package; use get_package_share_directory()",
        ),
        Example(
            "a bare file name; a file that is written",
            {
                "talker.py": _NODE.format("'words.txt'") + "\n\nopen('words.txt', 'w')\n",
                "config/words.txt": "",
            },
            "talker.py:5:15: 'words.txt' is relative to the current directory, not to the "
            "package; use get_package_share_directory()",
        ),
    )

    def check_in(self, package: Package, file: RclpyFile) -> Iterator[Diagnostic]:
        module = file.module
        for call in module.calls_of(*_READERS):
            if not call.args:
                continue
            value = file.evaluator.evaluate(call.args[0])
            text = value.text if isinstance(value, PathValue) else value
            if not isinstance(text, str):
                continue
            if re.fullmatch(_HOME, text):
                message = (
                    f"{text!r} exists only on the author's machine; install the file, and "
                    f"use get_package_share_directory()"
                )
                yield self.report(module.location(call.args[0]), message)
            elif (
                module.qualified_name(call.func) == "open"
                and _opens_for_reading(call)
                and _is_in(package, text)
            ):
                message = (
                    f"{text!r} is relative to the current directory, not to the package; use "
                    f"get_package_share_directory()"
                )
                yield self.report(module.location(call.args[0]), message)


def _opens_for_reading(call: ast.Call) -> bool:
    """Return whether ``open`` reads: it has no mode, or a literal mode for reading."""
    mode = argument_of(call, "mode", 1)
    return mode is None or (isinstance(mode, ast.Constant) and str(mode.value)[:1] == "r")


def _is_in(package: Package, text: str) -> bool:
    """Return whether a relative path is a file in the package, or the name of one."""
    path = text.removeprefix("./")
    if "/" in path:
        return package.has(path)
    return any(file == path or file.endswith(f"/{path}") for file in package.files)
