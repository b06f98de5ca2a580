"""PX022: dependencies are spelled correctly."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Edit, Example, Fix, Package, Report, Rule, Severity
from scaffold.api.catalog import OTHER_NAMES, similar_key, similar_package


class DependencyMisspelled(Rule):
    """The name of a dependency is misspelled, or one that no package has.

    **Why.** rosdep finds no rule for it: ``rosdep install`` and the release stop.

    **Fix.** Write the name as the package spells it.

    **Source.** ROS 2 documentation, "Managing dependencies with rosdep".
    """

    code = "PX022"
    name = "dependency-misspelled"
    other_severities = {
        Severity.WARNING: "the name is one that other packages suggest, such as rclpy_action, or a "
        "key of Python",
    }
    release_refused = "bloom finds no rule of rosdep for the name"
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
                "2:11", "no package 'std_msg' is known; closest: 'std_msgs'", fix="write std_msgs"
            ),
            fixed={"package.xml": "<package>\n  <depend>std_msgs</depend>\n</package>\n"},
        ),
        Example(
            "for another distribution, and for whoever asks for it",
            {
                "package.xml": "<package>\n"
                '  <depend condition="$ROS_DISTRO == humble">std_msg</depend>\n'
                '  <depend condition="$WITH_STAMPS == 1">builtin_interface</depend>\n'
                "</package>\n"
            },
            Report(
                "3:41",
                "no package 'builtin_interface' is known; closest: 'builtin_interfaces'",
                fix="write builtin_interfaces",
            ),
            fixed={
                "package.xml": "<package>\n"
                '  <depend condition="$ROS_DISTRO == humble">std_msg</depend>\n'
                '  <depend condition="$WITH_STAMPS == 1">builtin_interfaces</depend>\n'
                "</package>\n"
            },
        ),
        Example(
            "a key of rosdep with a letter too many",
            {"package.xml": "<package>\n  <depend>python3-opencvv</depend>\n</package>\n"},
            Report(
                "2:11",
                "no rosdep key 'python3-opencvv' is known; closest: 'python3-opencv'",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "a key of rosdep that resembles another one",
            {"package.xml": "<package>\n  <depend>python3-scapy</depend>\n</package>\n"},
        ),
        Example(
            "a key that this machine knows",
            {"package.xml": "<package>\n  <depend>python3-opencvv</depend>\n</package>\n"},
            rosdep_keys=("python3-opencvv",),
        ),
        Example(
            "a name that was never one",
            {"package.xml": "<package>\n  <depend>rclpy_action</depend>\n</package>\n"},
            Report(
                "2:11", "no package 'rclpy_action' is known; use 'rclpy'", severity=Severity.WARNING
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for dependency in package.manifest.dependencies:
            name = dependency.name
            if package.workspace.get(name) is not None or name == package.name:
                continue
            if not dependency.may_be_active:
                continue
            other = OTHER_NAMES.get(name)
            if other is not None:
                message = f"no package {name!r} is known; use {other!r}"
                yield self.report(dependency, message, severity=Severity.WARNING)
            key = similar_key(name)
            if key is not None and not _is_known(package, name):
                message = f"no rosdep key {name!r} is known; closest: {key!r}"
                yield self.report(dependency, message, severity=Severity.WARNING)
            closest = similar_package(name)
            if closest is not None:
                message = f"no package {name!r} is known; closest: {closest!r}"
                edit = Edit("package.xml", *dependency.element.text_span, closest)
                yield self.report(dependency, message, Fix(f"write {closest}", (edit,)))


def _is_known(package: Package, name: str) -> bool:
    """Tell whether rosdep's cache, where there is one, has a rule for a name."""
    rosdep = package.workspace.rosdep
    return rosdep is not None and rosdep.resolves(name) is not False
