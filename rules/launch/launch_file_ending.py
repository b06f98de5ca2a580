"""LF001: launch files are named as launch files."""

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
    """A launch file has a name that ``ros2 launch`` does not offer.

    **Why.** ``ros2 launch <package> <TAB>`` and tools that look for launch files list only what
    ends with ``launch.py``; so do the usual patterns such as ``glob('launch/*launch.py')``.

    **Fix.** Name it ``<something>.launch.py`` or ``<something>_launch.py``.

    **Source.** ``ros2launch/api/api.py``, ``is_launch_file``; ROS 2 documentation, "Launch system".
    """

    code = "LF001"
    name = "launch-file-ending"
    severity = Severity.WARNING
    examples = (
        Example("both endings", {"launch/a.launch.py": _LAUNCH, "launch/b_launch.py": _LAUNCH}),
        Example("what others include", {"launch/include/nodes.py": _LAUNCH}),
        Example(
            "neither",
            {"launch/talk.py": _LAUNCH},
            "1:1: defines generate_launch_description, but `ros2 launch` lists only names that "
            "end with launch.py, not talk.py",
        ),
    )

    def check_in(self, package: Package, launch: LaunchFile) -> Iterator[Diagnostic]:
        directory, _, name = launch.path.rpartition("/")
        parts = directory.split("/")
        if name.endswith("launch.py") or "launch" not in parts or _INCLUDED & {*parts}:
            return
        if launch.function is not None and not package.has(f"{directory}/__init__.py"):
            message = (
                f"defines {FUNCTION}, but `ros2 launch` lists only names that end with "
                f"launch.py, not {name}"
            )
            yield self.report(package.start_of(launch.path), message)
