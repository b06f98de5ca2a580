"""LF004: a launch file names packages that exist."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Edit, Example, Fix, Package, Report, Rule, Safety
from scaffold.api.launch import Reference, meant_package, package_uses
from scaffold.api.manifest import name_used_elsewhere

_LAUNCH = (
    "from launch import LaunchDescription\nfrom launch_ros.actions import Node\n\n\n"
    "def generate_launch_description():\n"
    "    return LaunchDescription([\n"
    "        Node(package='{}', executable='{}'),\n    ])\n"
)
_FILES = {
    "package.xml": '<package format="3"><name>talker_demo</name>'
    "<export><build_type>ament_python</build_type></export></package>\n",
    "setup.py": "from setuptools import setup\n\nsetup(\n    name='talker_demo',\n"
    "    entry_points={'console_scripts': ['talk = talker_demo.talk:main']},\n)\n",
}


class PackageMisspelled(Rule):
    """A launch file misspells the name of a package.

    **Why.** ``ros2 launch`` stops: ``package 'talker_dmeo' not found, searching: [...]``.

    **Fix.** Use the name in its package.xml.

    **Source.** ``launch_ros/substitutions/find_package.py``.
    """

    code = "LF004"
    name = "package-misspelled"
    examples = (
        Example(
            "itself, a known one, a declared one, and one unlike any known name",
            {
                **_FILES,
                "launch/a.launch.py": _LAUNCH.format("talker_demo", "talk"),
                "launch/b.launch.py": _LAUNCH.format("rviz2", "rviz2"),
                "launch/c.launch.py": _LAUNCH.format("our_driver", "driver"),
            },
        ),
        Example(
            "letters swapped; another name, but the program is here",
            {
                **_FILES,
                "launch/a.launch.py": _LAUNCH.format("talker_dmeo", "listen"),
                "launch/b.launch.py": _LAUNCH.format("demo", "talk"),
                "launch/c.launch.xml": '<launch>\n  <node pkg="rivz2" exec="rviz2"/>\n</launch>\n',
            },
            Report(
                "launch/a.launch.py:7:22",
                "unknown package 'talker_dmeo'; did you mean 'talker_demo' (this package)?",
                unsafe_fix="write talker_demo",
            ),
            Report(
                "launch/b.launch.py:7:22",
                "unknown package 'demo'; did you mean 'talker_demo' (it has the program 'talk')?",
                unsafe_fix="write talker_demo",
            ),
            Report(
                "launch/c.launch.xml:2:14",
                "unknown package 'rivz2'; did you mean 'rviz2' (a package of ROS)?",
                unsafe_fix="write rviz2",
            ),
            fixed={
                "launch/a.launch.py": _LAUNCH.format("talker_demo", "listen"),
                "launch/b.launch.py": _LAUNCH.format("talker_demo", "talk"),
                "launch/c.launch.xml": '<launch>\n  <node pkg="rviz2" exec="rviz2"/>\n</launch>\n',
            },
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for use in package_uses(package):
            if use.name == name_used_elsewhere(package):
                continue
            closest = meant_package(package, use)
            if closest is None:
                continue
            fix = self._fix(package, use, closest.name)
            message = (
                f"unknown package {use.name!r}; did you mean {closest.name!r} ({closest.reason})?"
            )
            yield self.report(use.location, message, fix)

    def _fix(self, package: Package, use: Reference, name: str) -> Fix | None:
        source = package.editable(use.location.path)
        at = use.location
        start = source.offset(at.line, at.column)
        end = source.offset(at.end_line, at.end_column)
        offset = source.text.find(use.name, start, end)
        if offset < 0:
            return None
        edit = Edit(at.path, offset, offset + len(use.name), name)
        return Fix(f"write {name}", (edit,), Safety.UNSAFE)
