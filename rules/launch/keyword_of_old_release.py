"""LF009: the keywords of a node are those of this release."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Edit, Example, Fix, LaunchRule, Report
from scaffold.api.launch import NODES, LaunchFile
from scaffold.api.rclpy import is_tried

_OLD = {
    "node_executable": "executable",
    "node_name": "name",
    "node_namespace": "namespace",
    "node_plugin": "plugin",
}
_RELEASES = frozenset({"crystal", "dashing", "eloquent", "foxy", "ROS_DISTRO"})
_LAUNCH = (
    "from launch import LaunchDescription\nfrom launch_ros.actions import Node\n\n\n"
    "def generate_launch_description():\n"
    "    return LaunchDescription([\n"
    "        Node(package='talker', {}='talk', {}='talker'),\n    ])\n"
)


class KeywordOfOldRelease(LaunchRule):
    """A node has keywords that were renamed in Foxy and removed in Galactic.

    **Why.** ``TypeError: Node.__init__() missing 1 required keyword-only argument:
    'executable'``; the name given with ``node_name`` is an unexpected keyword.

    **Fix.** ``executable``, ``name`` and ``namespace``; ``plugin`` for components.

    **Source.** ROS 2 documentation, release notes of Foxy Fitzroy, "launch_ros".
    """

    code = "LF009"
    name = "keyword-of-old-release"
    examples = (
        Example("of today", {"launch/a.launch.py": _LAUNCH.format("executable", "name")}),
        Example(
            "of Eloquent, for Eloquent",
            {
                "launch/a.launch.py": _LAUNCH.format("node_executable", "node_name").replace(
                    "    return", "    if os.environ['ROS_DISTRO'] == 'eloquent':\n        return"
                )
            },
        ),
        Example(
            "of Eloquent",
            {"launch/a.launch.py": _LAUNCH.format("node_executable", "node_name")},
            Report(
                "7:32",
                "Node has no node_executable: it was renamed to executable",
                fix="write executable",
            ),
            Report("7:56", "Node has no node_name: it was renamed to name", fix="write name"),
            fixed={"launch/a.launch.py": _LAUNCH.format("executable", "name")},
        ),
    )

    def check_file(self, launch: LaunchFile) -> Iterator[Diagnostic]:
        for call in launch.find(*NODES, "ComposableNode"):
            if _is_for_release(launch, call.call):
                continue
            for old, word in call.words.items():
                new = _OLD.get(old)
                if new is None or is_tried(launch.module, call.call, old):
                    continue
                start, _ = launch.module.span(word)
                at = launch.module.source.location(start, start + len(old))
                fix = None
                if new not in call.words:
                    edit = Edit(launch.path, start, start + len(old), new)
                    fix = Fix(f"write {new}", (edit,))
                message = f"{call.kind} has no {old}: it was renamed to {new}"
                yield self.report(at, message, fix, cause="keywords of an old release")


def _is_for_release(launch: LaunchFile, call: ast.Call) -> bool:
    """Tell whether a call is run for another release of ROS only."""
    return any(
        isinstance(parent, ast.If | ast.IfExp)
        and any(
            isinstance(part, ast.Constant) and part.value in _RELEASES
            for part in ast.walk(parent.test)
        )
        for parent in launch.module.parents(call)
    )
