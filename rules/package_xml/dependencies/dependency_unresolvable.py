"""PX028: rosdep can resolve the dependencies."""

from __future__ import annotations

import os
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Rule, Severity
from scaffold.api.catalog import (
    OTHER_NAMES,
    ROS1_PACKAGES,
    ROS_PACKAGES,
    is_released,
    module_of_key,
    similar_key,
    similar_package,
)
from scaffold.api.distributions import removed_package, target

KINDS = frozenset(
    {"depend", "build_depend", "buildtool_depend", "exec_depend", "run_depend", "test_depend"}
    | {"build_export_depend", "buildtool_export_depend"}
)
"""Tags whose packages rosdep installs; it skips documentation dependencies."""
_MANIFEST = "<package>\n  <name>talker</name>\n  <depend>{}</depend>\n</package>\n"
_KEYS = ("python3-serial", "libserial-dev")


class DependencyUnresolvable(Rule):
    """A dependency is neither a rosdep key nor an available package.

    Only reported after ``rosdep update``. A rule for any operating system is enough, because the
    package may be meant for another one. The keys include the packages of the distribution.

    **Why.** ``rosdep install`` stops: ``Cannot locate rosdep definition for [pyserial-3]``. The
    build farm and users who install the dependencies get the same error.

    **Fix.** Use a key that ``rosdep search`` finds, clone the missing package into the workspace,
    or add a rule to rosdep.

    **Source.** REP 111; ROS 2 documentation, "Managing dependencies with rosdep".
    """

    code = "PX028"
    name = "dependency-unresolvable"
    severity = Severity.WARNING
    release_refused = "bloom finds no rosdep rule for the name"
    examples = (
        Example(
            "a key of rosdep",
            {"package.xml": _MANIFEST.format("python3-serial")},
            rosdep_keys=_KEYS,
        ),
        Example(
            "a package of the workspace",
            {"package.xml": _MANIFEST.format("robot-serial")},
            neighbors={"serial": {"package.xml": "<package><name>robot-serial</name></package>"}},
            rosdep_keys=_KEYS,
        ),
        Example("rosdep is not installed", {"package.xml": _MANIFEST.format("pyserial-3")}),
        Example(
            "a package from another prefix",
            {"package.xml": _MANIFEST.format("robot_serial")},
            "3:11: unknown dependency 'robot_serial': rosdep has no rule for it, and it is not a "
            "package in the workspace or AMENT_PREFIX_PATH",
            rosdep_keys=_KEYS,
        ),
        Example(
            "neither a key nor a package",
            {"package.xml": _MANIFEST.format("pyserial-3")},
            "3:11: unknown dependency 'pyserial-3': rosdep has no rule for it, and it is not a "
            "package in the workspace or AMENT_PREFIX_PATH",
            rosdep_keys=_KEYS,
        ),
        Example(
            "a package of another distribution",
            {"package.xml": _MANIFEST.format("turtlebot4_desktop")},
            "3:11: unknown dependency 'turtlebot4_desktop': rosdep has no rule for it, and it is "
            "not a package in the workspace or AMENT_PREFIX_PATH; Jazzy lacks it, other "
            "distributions have it",
            rosdep_keys=_KEYS,
        ),
        Example(
            "another spelling",
            {"package.xml": _MANIFEST.format("Serial")},
            "3:11: unknown dependency 'Serial': rosdep has no rule for it, and it is not a "
            "package in the workspace or AMENT_PREFIX_PATH; it has 'python3-serial'",
            rosdep_keys=_KEYS,
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        seen: set[str] = set()
        for dependency in package.manifest.dependencies:
            name = dependency.name
            if dependency.kind not in KINDS or dependency.condition or name in seen:
                continue
            seen.add(name)
            if not name or "$" in name or _is_known(package, name):
                continue
            rosdep = package.workspace.rosdep
            if rosdep is None:
                return
            if rosdep.resolves(name) is False:
                message = (
                    f"unknown dependency {name!r}: rosdep has no rule for it, and it is not a "
                    f"package in the workspace or AMENT_PREFIX_PATH{_hint(package, name)}"
                )
                yield self.report(dependency, message, cause=f"dependency {name}")


def _is_known(package: Package, name: str) -> bool:
    """Return whether a name is a known package, or another rule reports it."""
    if name in {*ROS_PACKAGES, *ROS1_PACKAGES, *OTHER_NAMES, package.name}:
        return True
    if removed_package(name) is not None:
        return True
    if (
        similar_package(name)
        or similar_key(name)
        or module_of_key(name)
        or package.workspace.get(name) is not None
    ):
        return True
    prefixes = os.environ.get("AMENT_PREFIX_PATH", "").split(os.pathsep)
    marker = os.path.join("share/ament_index/resource_index/packages", name)
    return any(
        package.outside.is_file(os.path.join(prefix, marker)) for prefix in prefixes if prefix
    )


def _hint(package: Package, name: str) -> str:
    if is_released(name):
        return f"; {target().title} lacks it, other distributions have it"
    rosdep = package.workspace.rosdep
    plain = name.replace("_", "-").lower()
    for guess in (f"python3-{plain.removeprefix('python-')}", plain, f"{plain}-dev"):
        if guess != name and rosdep is not None and rosdep.resolves(guess):
            return f"; it has {guess!r}"
    return ""
