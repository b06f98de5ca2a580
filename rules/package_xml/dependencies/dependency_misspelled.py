"""PX022: dependencies are spelled correctly."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Edit, Effect, Example, Fix, Package, Report, Rule
from scaffold.api.catalog import (
    OTHER_NAMES,
    similar_key,
    similar_package,
)
from scaffold.api.interfaces import KINDS
from scaffold.api.manifest import is_fetched

from ._meant_packages import is_in_rosdep_cache, similar_neighbor


class DependencyMisspelled(Rule):
    """The name of a dependency is misspelled or does not exist.

    **Why.** rosdep has no key for it: ``rosdep install`` and the release stop.

    **Fix.** Correct the spelling.

    **Source.** ROS 2 documentation, "Managing dependencies with rosdep".
    """

    code = "PX022"
    name = "dependency-misspelled"
    effect = Effect.STOPS_ROSDEP
    release_refused = "bloom finds no rosdep rule for the name"
    examples = (
        Example(
            "correct, and an unknown one",
            {
                "package.xml": "<package>\n  <depend>std_msgs</depend>\n"
                "  <depend>our_own_msgs</depend>\n</package>\n"
            },
        ),
        Example(
            "a letter is missing",
            {"package.xml": "<package>\n  <depend>std_msg</depend>\n</package>\n"},
            Report(
                "2:11",
                "unknown package 'std_msg': rosdep stops; did you mean 'std_msgs'?",
                fix="Replace with std_msgs",
            ),
            fixed={"package.xml": "<package>\n  <depend>std_msgs</depend>\n</package>\n"},
        ),
        Example(
            "an extra letter, in a package of the workspace; others that code imports or includes",
            {
                "package.xml": "<package>\n  <name>talker</name>\n"
                "  <depend>our_arm_msgss</depend>\n  <depend>our_hand_msgss</depend>\n"
                "  <depend>our_foot_msgss</depend>\n</package>\n",
                "talker.py": "from our_hand_msgss.msg import Grip\n",
                "src/walk.cpp": "#include <our_foot_msgss/msg/step.hpp>\n",
            },
            Report(
                "package.xml:3:11",
                "unknown package 'our_arm_msgss': rosdep stops; did you mean 'our_arm_msgs'?",
                fix="Replace with our_arm_msgs",
            ),
            neighbors={
                name: {"package.xml": f"<package>\n  <name>{name}</name>\n</package>\n"}
                for name in ("our_arm_msgs", "our_foot_msgs", "our_hand_msgs")
            },
            fixed={
                "package.xml": "<package>\n  <name>talker</name>\n"
                "  <depend>our_arm_msgs</depend>\n  <depend>our_hand_msgss</depend>\n"
                "  <depend>our_foot_msgss</depend>\n</package>\n"
            },
        ),
        Example(
            "misspelled in the code as well",
            {
                "package.xml": "<package>\n  <depend>std_msg</depend>\n</package>\n",
                "talker.py": "from std_msg.msg import String\n",
            },
            Report(
                "package.xml:2:11",
                "unknown package 'std_msg': rosdep stops; did you mean 'std_msgs'?",
                fix="Replace with std_msgs",
            ),
            fixed={"package.xml": "<package>\n  <depend>std_msgs</depend>\n</package>\n"},
        ),
        Example(
            "a package with a similar name that has other interfaces",
            {
                "package.xml": "<package>\n  <depend>trajectory_msg</depend>\n</package>\n",
                "talker.py": "from trajectory_msg.srv import Follow\n",
            },
        ),
        Example(
            "for another distribution, and under a custom condition",
            {
                "package.xml": "<package>\n"
                '  <depend condition="$ROS_DISTRO == humble">std_msg</depend>\n'
                '  <depend condition="$WITH_STAMPS == 1">builtin_interface</depend>\n'
                "</package>\n"
            },
            Report(
                "3:41",
                "unknown package 'builtin_interface': rosdep stops; did you mean "
                "'builtin_interfaces'?",
                fix="Replace with builtin_interfaces",
            ),
            fixed={
                "package.xml": "<package>\n"
                '  <depend condition="$ROS_DISTRO == humble">std_msg</depend>\n'
                '  <depend condition="$WITH_STAMPS == 1">builtin_interfaces</depend>\n'
                "</package>\n"
            },
        ),
        Example(
            "a rosdep key with an extra letter",
            {"package.xml": "<package>\n  <depend>python3-opencvv</depend>\n</package>\n"},
            Report(
                "2:11",
                "unknown rosdep key 'python3-opencvv': rosdep stops; did you mean "
                "'python3-opencv'?",
            ),
        ),
        Example(
            "a rosdep key that is similar to another one",
            {"package.xml": "<package>\n  <depend>python3-scapy</depend>\n</package>\n"},
        ),
        Example(
            "a key in the local rosdep cache",
            {"package.xml": "<package>\n  <depend>python3-opencvv</depend>\n</package>\n"},
            rosdep_keys=("python3-opencvv",),
        ),
        Example(
            "a name that never existed",
            {"package.xml": "<package>\n  <depend>rclpy_action</depend>\n</package>\n"},
            Report(
                "2:11",
                "unknown package 'rclpy_action': rosdep stops; use 'rclpy'",
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for dependency in package.manifest.dependencies:
            name = dependency.name
            if package.workspace.get(name) is not None or name == package.name:
                continue
            if not dependency.may_be_active or is_fetched(package, name):
                continue
            other = OTHER_NAMES.get(name)
            if other is not None:
                message = f"unknown package {name!r}: rosdep stops; use {other!r}"
                yield self.report(dependency, message)
            key = similar_key(name)
            if key is not None and not is_in_rosdep_cache(package, name):
                message = f"unknown rosdep key {name!r}: rosdep stops; did you mean {key!r}?"
                yield self.report(dependency, message)
            closest = similar_package(name) or similar_neighbor(package, name)
            if closest is not None and not _has_others(package, name, closest):
                message = f"unknown package {name!r}: rosdep stops; did you mean {closest!r}?"
                edit = Edit("package.xml", *dependency.element.text_span, closest)
                yield self.report(dependency, message, Fix(f"Replace with {closest}", (edit,)))


def _has_others(package: Package, name: str, closest: str) -> bool:
    """Return whether the code imports interfaces that the closest package does not have."""
    definitions = package.workspace.interfaces
    for module in package.modules(mentioning=(name,)):
        for item in module.imports_by_root.get(name, ()):
            kind = item.module.partition(".")[2]
            names = definitions.names(closest, kind) or () if kind in KINDS else None
            if names is not None and any(imported.name not in names for imported in item.names):
                return True
    return False
