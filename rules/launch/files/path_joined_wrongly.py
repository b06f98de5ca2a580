"""LF044: parts of paths are joined with exactly one slash."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, LaunchRule
from scaffold.api.launch import SHARE, LaunchFile
from scaffold.api.python import PathValue

_LAUNCH = (
    "import os\n\nfrom ament_index_python.packages import get_package_share_directory\n"
    "import launch\n"
    "SHARE = get_package_share_directory('talker')\n{}\n"
)
_OF_SYSTEM = frozenset({"dev", "etc", "home", "media", "mnt", "opt", "root", "tmp", "usr", "var"})
"""Directories at the root of every Linux system: a path into them is meant to be absolute."""


class PathJoinedWrongly(LaunchRule):
    """A path in a share directory is joined with an extra slash, or without one.

    **Why.** ``os.path.join(share, '/config')`` is ``/config``; ``share + 'config'`` is
    ``.../talkerconfig``: the file is not found, and a node runs without its parameters.

    **Fix.** ``os.path.join(share, 'config', 'talker.yaml')``.

    **Source.** Python documentation, ``os.path.join``.
    """

    code = "LF044"
    name = "path-joined-wrongly"
    examples = (
        Example(
            "joined", {"launch/a.launch.py": _LAUNCH.format("PATH = os.path.join(SHARE, 'config')")}
        ),
        Example(
            "an absolute path, which replaces the parts before it",
            {
                "launch/a.launch.py": _LAUNCH.format(
                    "PATH = os.path.join(SHARE, '/opt/talk/a.yaml')"
                )
            },
        ),
        Example(
            "an extra slash",
            {"launch/a.launch.py": _LAUNCH.format("PATH = os.path.join(SHARE, '/config')")},
            "6:28: '/config' starts with a slash, which discards all parts before it; remove the "
            "slash",
        ),
        Example(
            "a missing slash in a list",
            {
                "launch/a.launch.py": _LAUNCH.format(
                    "from launch.launch_description_sources import PythonLaunchDescriptionSource\n"
                    "PATH = PythonLaunchDescriptionSource([SHARE, 'launch/b.launch.py'])\n"
                    "OTHER = PythonLaunchDescriptionSource([SHARE, '/launch', '/b.launch.py'])"
                )
            },
            "7:46: parts are concatenated: missing slash before this part",
        ),
        Example(
            "a missing slash",
            {"launch/a.launch.py": _LAUNCH.format("PATH = SHARE + 'config/a.yaml'")},
            "6:8: missing slash between the share directory and 'config/a.yaml': the file is not "
            "found",
        ),
    )

    def check_file(self, launch: LaunchFile) -> Iterator[Diagnostic]:
        for call in launch.module.calls_of("os.path.join"):
            if not call.args:
                continue
            first = _text(launch, call.args[0])
            for part in call.args[1:]:
                text = _text(launch, part)
                is_absolute = text.partition("/")[2].partition("/")[0] in _OF_SYSTEM
                if text.startswith("/") and not (is_absolute or text.startswith(SHARE)) and first:
                    message = (
                        f"{text!r} starts with a slash, which discards all parts before it; "
                        f"remove the slash"
                    )
                    yield self.report(launch.location(part), message)
        for sum_ in launch.module.walk(ast.BinOp):
            if isinstance(sum_.op, ast.Add) and _runs_on(launch, sum_.left, sum_.right):
                right = _text(launch, sum_.right)
                message = (
                    f"missing slash between the share directory and {right!r}: the file is "
                    f"not found"
                )
                yield self.report(launch.location(sum_), message)
        for node in _run_on_in_lists(launch):
            message = "parts are concatenated: missing slash before this part"
            yield self.report(launch.location(node), message)


def _run_on_in_lists(launch: LaunchFile) -> Iterator[ast.expr]:
    """Yield the parts of paths in lists that lack a ``/`` after the directory."""
    for call in launch.calls:
        listed = next(iter(call.given.values()), None)
        if call.kind.endswith("Source") and isinstance(listed, ast.List):
            for left, right in zip(listed.elts, listed.elts[1:], strict=False):
                if _runs_on(launch, left, right):
                    yield right


def _runs_on(launch: LaunchFile, left: ast.expr, right: ast.expr) -> bool:
    """Return whether a share directory is joined to the next text without a ``/``."""
    text = _text(launch, left)
    is_share = text.startswith(SHARE) and "/" not in text.removeprefix(SHARE)
    return is_share and _text(launch, right)[:1] not in {"", "/"}


def _text(launch: LaunchFile, node: ast.expr) -> str:
    value = launch.evaluator.evaluate(node)
    if isinstance(value, PathValue):
        value = value.text
    return value if isinstance(value, str) else ""
