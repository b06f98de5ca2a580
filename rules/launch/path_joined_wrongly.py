"""LF044: parts of paths are joined with one slash."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Rule
from scaffold.model.launch_py import SHARE, LaunchFile
from scaffold.model.values import PathValue

_LAUNCH = (
    "import os\n\nfrom ament_index_python.packages import get_package_share_directory\n"
    "import launch\n"
    "SHARE = get_package_share_directory('talker')\n{}\n"
)


class PathJoinedWrongly(Rule):
    """A path below a share directory is joined with a slash too many, or without one.

    **Why.** ``os.path.join(share, '/config')`` is ``/config``; ``share + 'config'`` is
    ``.../talkerconfig``: the file is not found, and a node runs without its parameters.

    **Fix.** ``os.path.join(share, 'config', 'talker.yaml')``.

    **Source.** Python documentation, ``os.path.join``.
    """

    code = "LF044"
    name = "path-joined-wrongly"
    examples = (
        Example(
            "joined",
            {"launch/a.launch.py": _LAUNCH.format("PATH = os.path.join(SHARE, 'config')")},
        ),
        Example(
            "a slash too many",
            {"launch/a.launch.py": _LAUNCH.format("PATH = os.path.join(SHARE, '/config')")},
            at=("launch/a.launch.py:6",),
        ),
        Example(
            "no slash",
            {"launch/a.launch.py": _LAUNCH.format("PATH = SHARE + 'config/a.yaml'")},
            at=("launch/a.launch.py:6",),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for launch in LaunchFile.of_package(package):
            for call in launch.module.walk(ast.Call):
                if launch.module.qualified_name(call.func) != "os.path.join" or not call.args:
                    continue
                first = _text(launch, call.args[0])
                for part in call.args[1:]:
                    text = _text(launch, part)
                    if text.startswith("/") and not text.startswith(SHARE) and first:
                        message = f"{text!r} begins with a slash, which drops all in front of it"
                        yield self.report(launch.location(part), message)
            for sum_ in launch.module.walk(ast.BinOp):
                left, right = _text(launch, sum_.left), _text(launch, sum_.right)
                is_share = left.startswith(SHARE) and "/" not in left.removeprefix(SHARE)
                if isinstance(sum_.op, ast.Add) and is_share and right[:1] not in {"", "/"}:
                    message = f"a slash is missing between the share directory and {right!r}"
                    yield self.report(launch.location(sum_), message)


def _text(launch: LaunchFile, node: ast.expr) -> str:
    value = launch.evaluator.evaluate(node)
    if isinstance(value, PathValue):
        value = value.text
    return value if isinstance(value, str) else ""
