"""LF001: the names of launch files end with launch.py."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, LaunchRule, Package, Severity
from scaffold.api.launch import FUNCTION, LaunchFile

_LAUNCH = (
    "from launch import LaunchDescription\n\n\n"
    "def generate_launch_description():\n    return LaunchDescription([])\n"
)

_INCLUDED = frozenset({"include", "includes"})
"""Directories of included files, which are not launched directly."""


class LaunchFileEnding(LaunchRule):
    """``ros2 launch`` does not list a launch file because of its name.

    **Why.** The completion of ``ros2 launch <package>`` and other tools only list files that end
    with ``launch.py``; common patterns such as ``glob('launch/*launch.py')`` only install those.

    **Fix.** Name it ``<something>.launch.py`` or ``<something>_launch.py``.

    **Source.** ``ros2launch/api/api.py``, ``is_launch_file``; ROS 2 documentation, "Launch system".
    """

    code = "LF001"
    name = "launch-file-ending"
    severity = Severity.WARNING
    examples = (
        Example("both suffixes", {"launch/a.launch.py": _LAUNCH, "launch/b_launch.py": _LAUNCH}),
        Example("included files", {"launch/include/nodes.py": _LAUNCH}),
        Example(
            "no suffix",
            {"launch/talk.py": _LAUNCH},
            "1:1: defines generate_launch_description, but `ros2 launch` does not list talk.py; "
            "use a name that ends with .launch.py",
        ),
    )

    def check_in(self, package: Package, launch: LaunchFile) -> Iterator[Diagnostic]:
        directory, _, name = launch.path.rpartition("/")
        parts = directory.split("/")
        if name.endswith("launch.py") or "launch" not in parts or _INCLUDED & {*parts}:
            return
        if launch.function is not None and not package.has(f"{directory}/__init__.py"):
            message = (
                f"defines {FUNCTION}, but `ros2 launch` does not list {name}; use a name that "
                f"ends with .launch.py"
            )
            yield self.report(package.start_of(launch.path), message)
