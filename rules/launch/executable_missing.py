"""LF006: launch files start programs that exist."""

from __future__ import annotations

from collections.abc import Iterator
from difflib import get_close_matches

from scaffold.api import Diagnostic, Example, Package, Report, Rule, listed_names
from scaffold.api.launch import package_uses
from scaffold.api.programs import programs_of

_LAUNCH = (
    "from launch import LaunchDescription\nfrom launch_ros.actions import Node\n\n\n"
    "def generate_launch_description():\n"
    "    return LaunchDescription([\n"
    "        Node(package='talker', executable='{}'),\n    ])\n"
)
_FILES = {
    "package.xml": '<package format="3"><name>talker</name>'
    "<export><build_type>ament_python</build_type></export></package>\n",
    "setup.py": "from setuptools import setup\n\nsetup(\n    name='talker',\n"
    "    entry_points={'console_scripts': ['talk = talker.talk:main']},\n)\n",
}


class ExecutableMissing(Rule):
    """A launch file starts a program that the package does not have.

    **Why.** ``executable 'talker' not found on the libexec directory
    '.../install/talker/lib/talker'``.

    **Fix.** Write the name of the entry point in setup.py, or of the script that CMakeLists.txt
    installs, with its ending; or install the program.

    **Source.** ``launch_ros/substitutions/executable_in_package.py``.
    """

    code = "LF006"
    name = "executable-missing"
    examples = (
        Example("an entry point", {**_FILES, "launch/a.launch.py": _LAUNCH.format("talk")}),
        Example(
            "the module's name",
            {**_FILES, "launch/a.launch.py": _LAUNCH.format("talk.py")},
            Report(
                "launch/a.launch.py:7:43",
                "talker has no program 'talk.py' (it has: talk); closest: 'talk'",
            ),
        ),
        Example(
            "one of many",
            {
                **_FILES,
                "setup.py": _FILES["setup.py"].replace(
                    "'talk = talker.talk:main'",
                    ", ".join(f"'{name}_node = talker.talk:main'" for name in "abcdefgh"),
                ),
                "launch/a.launch.py": _LAUNCH.format("g_nde"),
            },
            Report(
                "launch/a.launch.py:7:43",
                "talker has no program 'g_nde' (it has: g_node, a_node, b_node, "
                "c_node, d_node and 3 more); closest: 'g_node'",
            ),
        ),
        Example(
            "in another package of the workspace, in XML and in YAML",
            {
                "package.xml": '<package format="3"><name>bringup</name></package>\n',
                "launch/a.launch.xml": '<launch>\n  <node pkg="talker" exec="tlk"/>\n</launch>\n',
                "launch/b.launch.yaml": "launch:\n- node:\n    pkg: talker\n    exec: tlk\n",
            },
            Report(
                "launch/a.launch.xml:2:28",
                "talker has no program 'tlk' (it has: talk); closest: 'talk'",
            ),
            Report(
                "launch/b.launch.yaml:4:11",
                "talker has no program 'tlk' (it has: talk); closest: 'talk'",
            ),
            neighbours={"talker": _FILES},
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for use in package_uses(package):
            name = use.executable
            other = package if use.name == package.name else package.workspace.get(use.name)
            if other is None or not isinstance(name, str) or use.is_optional:
                continue
            programs = programs_of(other)
            if not programs.complete or name in programs.sources:
                continue
            if other is package and self._is_script(package, name):
                continue
            have = listed_names(programs.sources, name)
            closest = get_close_matches(name, programs.sources, 1, 0.7)
            hint = f"; closest: {closest[0]!r}" if closest else ""
            message = f"{use.name} has no program {name!r} (it has: {have}){hint}"
            cause = "" if programs.sources else f"programs of {use.name}"
            yield self.report(use.executable_location, message, cause=cause)

    def _is_script(self, package: Package, name: str) -> bool:
        """Tell whether the package has such a script: another rule reports that it is missing."""
        return any(
            path.rpartition("/")[2] == name and package.module(path).is_script
            for path in package.python_files
            if path.endswith(name)
        )
