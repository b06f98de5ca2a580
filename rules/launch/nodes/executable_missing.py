"""LF006: packages and executables in launch files exist."""

from __future__ import annotations

from collections.abc import Iterator
from difflib import get_close_matches

from scaffold.api import Diagnostic, Edit, Example, Fix, Package, Report, Rule, Safety, listed_names
from scaffold.api.launch import Reference, meant_package, package_uses
from scaffold.api.manifest import name_used_elsewhere
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
_LAUNCH_PACKAGES = (
    "from launch import LaunchDescription\nfrom launch_ros.actions import Node\n\n\n"
    "def generate_launch_description():\n"
    "    return LaunchDescription([\n"
    "        Node(package='{}', executable='{}'),\n    ])\n"
)
_FILES_PACKAGES = {
    "package.xml": '<package format="3"><name>talker_demo</name>'
    "<export><build_type>ament_python</build_type></export></package>\n",
    "setup.py": "from setuptools import setup\n\nsetup(\n    name='talker_demo',\n"
    "    entry_points={'console_scripts': ['talk = talker_demo.talk:main']},\n)\n",
}
_NO_ENTRY_POINT = "nodes without entry points: error"
"""The cause of node-without-entry-point, which reports the same in setup.py."""


class ExecutableMissing(Rule):
    """A launch file or smoke.yaml names a package or an executable that does not exist.

    **Why.** ``ros2 launch`` stops: ``package 'talker_dmeo' not found, searching: [...]``, or
    ``executable 'talker' not found on the libexec directory '.../install/talker/lib/talker'``.

    **Fix.** Use the package name from package.xml, and the name of the entry point in setup.py or
    of the script that CMakeLists.txt installs, including its extension; or install the executable.

    **Source.** ``launch_ros/substitutions/find_package.py``, ``executable_in_package.py``.
    """

    code = "LF006"
    name = "executable-missing"
    examples = (
        Example("an entry point", {**_FILES, "launch/a.launch.py": _LAUNCH.format("talk")}),
        Example(
            "a node that is created, but never launched",
            {
                **_FILES,
                "launch/a.launch.py": "from launch import LaunchDescription\n"
                "from launch_ros.actions import Node\n\n\n"
                "def generate_launch_description():\n"
                "    description = LaunchDescription()\n"
                "    face = Node(package='talker', executable='face')\n"
                "    talk = Node(package='talker', executable='talk')\n"
                "    # description.add_action(face)\n"
                "    description.add_action(talk)\n"
                "    return description\n",
            },
        ),
        Example(
            "the name of the module",
            {**_FILES, "launch/a.launch.py": _LAUNCH.format("talk.py")},
            "launch/a.launch.py:7:43: talker has no executable 'talk.py'; did you mean 'talk'?",
        ),
        Example(
            "a name unlike all others",
            {
                **_FILES,
                "setup.py": _FILES["setup.py"].replace(
                    "'talk = talker.talk:main'",
                    ", ".join(f"'{name}_node = talker.talk:main'" for name in "abcdefgh"),
                ),
                "launch/a.launch.py": _LAUNCH.format("listener"),
            },
            "launch/a.launch.py:7:43: talker has no executable 'listener'; it has a_node, b_node, "
            "c_node, d_node, e_node and 3 more",
        ),
        Example(
            "in another package of the workspace, in XML and in YAML",
            {
                "package.xml": '<package format="3"><name>bringup</name></package>\n',
                "launch/a.launch.xml": '<launch>\n  <node pkg="talker" exec="tlk"/>\n</launch>\n',
                "launch/b.launch.yaml": "launch:\n- node:\n    pkg: talker\n    exec: tlk\n",
            },
            "launch/a.launch.xml:2:28: talker has no executable 'tlk'; did you mean 'talk'?",
            "launch/b.launch.yaml:4:11: talker has no executable 'tlk'; did you mean 'talk'?",
            neighbors={"talker": _FILES},
        ),
        Example(
            "packages: itself, a known one, a declared one, and one without a similar name",
            {
                **_FILES_PACKAGES,
                "launch/a.launch.py": _LAUNCH_PACKAGES.format("talker_demo", "talk"),
                "launch/b.launch.py": _LAUNCH_PACKAGES.format("rviz2", "rviz2"),
                "launch/c.launch.py": _LAUNCH_PACKAGES.format("our_driver", "driver"),
            },
        ),
        Example(
            "a package with swapped letters; another package, but the executable is in this one",
            {
                **_FILES_PACKAGES,
                "launch/a.launch.py": _LAUNCH_PACKAGES.format("talker_dmeo", "talk"),
                "launch/b.launch.py": _LAUNCH_PACKAGES.format("demo", "talk"),
                "launch/c.launch.xml": '<launch>\n  <node pkg="rivz2" exec="rviz2"/>\n'
                '  <node pkg="talker_dmeo" exec="$(var program)"/>\n</launch>\n',
            },
            Report(
                "launch/a.launch.py:7:22",
                "unknown package 'talker_dmeo'; did you mean 'talker_demo' (it has the "
                "executable 'talk')?",
                unsafe_fix="Replace with talker_demo",
            ),
            Report(
                "launch/b.launch.py:7:22",
                "unknown package 'demo'; did you mean 'talker_demo' (it has the "
                "executable 'talk')?",
                unsafe_fix="Replace with talker_demo",
            ),
            Report(
                "launch/c.launch.xml:2:14",
                "unknown package 'rivz2'; did you mean 'rviz2' (a package of ROS)?",
                unsafe_fix="Replace with rviz2",
            ),
            Report(
                "launch/c.launch.xml:3:14",
                "unknown package 'talker_dmeo'; did you mean 'talker_demo' (this package)?",
                unsafe_fix="Replace with talker_demo",
            ),
            fixed={
                "launch/a.launch.py": _LAUNCH_PACKAGES.format("talker_demo", "talk"),
                "launch/b.launch.py": _LAUNCH_PACKAGES.format("talker_demo", "talk"),
                "launch/c.launch.xml": '<launch>\n  <node pkg="rviz2" exec="rviz2"/>\n'
                '  <node pkg="talker_demo" exec="$(var program)"/>\n</launch>\n',
            },
        ),
        Example(
            "executables in smoke.yaml",
            {
                **_FILES,
                "smoke.yaml": "executables:\n  talk: {skip: true}\n  talker: {skip: true}\n",
            },
            "smoke.yaml:3:3: talker has no executable 'talker'; did you mean 'talk'?",
        ),
        Example(
            "executables in a loop and in a helper function",
            {
                **_FILES,
                "launch/a.launch.py": "from launch import LaunchDescription\n"
                "from launch_ros.actions import Node\n\n\n"
                "def node(name):\n    return Node(package='talker', executable=name)\n\n\n"
                "def generate_launch_description():\n    ld = LaunchDescription()\n"
                "    for name, space in {'talk': 'a', 'hear': 'b'}.items():\n"
                "        ld.add_action(Node(package='talker', executable=name, namespace=space))\n"
                "    ld.add_action(node('talk'))\n    ld.add_action(node('say'))\n    return ld\n",
            },
            "launch/a.launch.py:11:38: talker has no executable 'hear'; it has talk",
            "launch/a.launch.py:14:24: talker has no executable 'say'; it has talk",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        yield from self._check_programs(package)
        yield from self._check_packages(package)

    def _check_programs(self, package: Package) -> Iterator[Diagnostic]:
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
            closest = get_close_matches(name, programs.sources, 1, 0.7)
            has = f"it has {listed_names(programs.sources, name)}"
            hint = f"did you mean {closest[0]!r}?" if closest else has
            message = f"{use.name} has no executable {name!r}; {hint}"
            cause = "" if programs.sources else f"executables of {use.name}"
            if other is package and _is_module(package, name):
                cause = _NO_ENTRY_POINT
            yield self.report(use.executable_location, message, cause=cause)

    def _is_script(self, package: Package, name: str) -> bool:
        """Return whether the package has such a script: another rule reports that it is missing."""
        return any(
            path.rpartition("/")[2] == name and package.module(path).is_script
            for path in package.python_files
            if path.endswith(name)
        )

    def _check_packages(self, package: Package) -> Iterator[Diagnostic]:
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
            yield self.report(use.location, message, fix, cause=f"unknown package {use.name}")

    def _fix(self, package: Package, use: Reference, name: str) -> Fix | None:
        source = package.editable(use.location.path)
        at = use.location
        start = source.offset(at.line, at.column)
        end = source.offset(at.end_line, at.end_column)
        offset = source.text.find(use.name, start, end)
        if offset < 0:
            return None
        edit = Edit(at.path, offset, offset + len(use.name), name)
        return Fix(f"Replace with {name}", (edit,), Safety.UNSAFE)


def _is_module(package: Package, name: str) -> bool:
    """Return whether a module of the package has a name, so that it may lack an entry point."""
    return any(path.rpartition("/")[2] == f"{name}.py" for path in package.python_files)
