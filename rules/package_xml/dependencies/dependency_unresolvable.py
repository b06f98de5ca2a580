"""PX028: rosdep can resolve the dependencies."""

from __future__ import annotations

import os
import re
from collections import Counter
from collections.abc import Iterator
from contextlib import suppress

from scaffold.api import Diagnostic, Effect, Example, Package, Report, Rule, Severity, ViewError
from scaffold.api.catalog import (
    OTHER_NAMES,
    ROS1_PACKAGES,
    ROS_PACKAGES,
    has_rosdep_rule,
    is_released,
    is_rosdep_key,
    keys_of_module,
    module_of_key,
    similar_key,
    similar_package,
)
from scaffold.api.distributions import removed_package, target
from scaffold.api.manifest import declared, is_fetched

from ._meant_packages import package_of_key, similar_neighbor
from ._names_without_key import why_no_key

_PACKAGE = re.compile(r"[a-z][a-z0-9_]*")
"""Matches what the packages of ROS are named like."""
KINDS = frozenset(
    {"depend", "build_depend", "buildtool_depend", "exec_depend", "run_depend", "test_depend"}
    | {"build_export_depend", "buildtool_export_depend"}
)
"""Tags whose packages rosdep installs; it skips documentation dependencies."""
_IN_FAMILY = 2
"""The number of words that the names of a family share; more packages are a larger system."""
_MANIFEST = "<package>\n  <name>talker</name>\n  <depend>{}</depend>\n</package>\n"
_KEYS = ("python3-serial", "libserial-dev")


class DependencyUnresolvable(Rule):
    """A dependency is neither a rosdep key nor an available package.

    The keys are those of ``rosdep update``, and those that this tool knows, which include the
    packages of the distribution. A key that has rules for other versions of Ubuntu only is
    reported; a key for other systems is not, because the package may be meant for them.

    **Why.** ``rosdep install`` stops: ``Cannot locate rosdep definition for [pyserial-3]``. The
    build farm and users who install the dependencies get the same error.

    **Fix.** Use a key that ``rosdep search`` finds, clone the missing package into the workspace,
    or add a rule to rosdep.

    **Source.** REP 111; ROS 2 documentation, "Managing dependencies with rosdep".
    """

    code = "PX028"
    name = "dependency-unresolvable"
    effect = Effect.STOPS_ROSDEP
    other_severities = {
        Severity.WARNING: "it may be a package of ROS that is built from other sources; or the "
        "workspace needs a family of unknown packages, whose vendor may add rules to rosdep"
    }
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
        Example(
            "keys, one of them only for other systems",
            {
                "package.xml": "<package>\n  <name>talker</name>\n"
                "  <depend>python3-serial</depend>\n  <depend>omniorb</depend>\n</package>\n"
            },
        ),
        Example(
            "a package from another prefix",
            {"package.xml": _MANIFEST.format("robot_serial")},
            Report(
                "3:11",
                "unknown dependency 'robot_serial': rosdep has no rule for it, and it "
                "is not a package in the workspace or AMENT_PREFIX_PATH",
                severity=Severity.WARNING,
            ),
            rosdep_keys=_KEYS,
        ),
        Example(
            "a package from another prefix, without the cache of rosdep",
            {"package.xml": _MANIFEST.format("robot_serial")},
            Report(
                "3:11",
                "unknown dependency 'robot_serial': rosdep has no rule for it, and it "
                "is not a package in the workspace or AMENT_PREFIX_PATH",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "neither a key nor a package",
            {"package.xml": _MANIFEST.format("pyserial-3")},
            "3:11: unknown dependency 'pyserial-3': rosdep has no rule for it, and it is not a "
            "package in the workspace or AMENT_PREFIX_PATH",
            rosdep_keys=_KEYS,
        ),
        Example(
            "a key without a rule for this system, and one of pip that has a rule",
            {"package.xml": _MANIFEST.format("python3-open3d")},
            "3:11: rosdep has no rule for 'python3-open3d' on Ubuntu Noble, the system of "
            "Jazzy: it stops; 'python3-open3d-pip' has one",
        ),
        Example(
            "a key in place of the package that the distribution has",
            {"package.xml": _MANIFEST.format("python3-py-trees")},
            "3:11: unknown dependency 'python3-py-trees': rosdep has no rule for it, and it is "
            "not a package in the workspace or AMENT_PREFIX_PATH; the package is 'py_trees'",
        ),
        Example(
            "another spelling of a package of the workspace, which PX022 reports",
            {"package.xml": _MANIFEST.format("arm-planner")},
            neighbors={
                "arm_planner": {"package.xml": "<package><name>arm_planner</name></package>"}
            },
        ),
        Example(
            "a key of the vendor of other unknown packages",
            {
                "package.xml": _MANIFEST.format(
                    "arm_core_msgs</depend>\n  <depend>arm_core_driver</depend>\n"
                    "  <depend>arm_core_tools</depend>\n  <depend>python3-arm-shim"
                )
            },
            Report(
                "3:11",
                "unknown dependency 'arm_core_msgs': rosdep has no rule for it, and it "
                "is not a package in the workspace or AMENT_PREFIX_PATH",
                severity=Severity.WARNING,
            ),
            Report(
                "4:11",
                "unknown dependency 'arm_core_driver': rosdep has no rule for it, and "
                "it is not a package in the workspace or AMENT_PREFIX_PATH",
                severity=Severity.WARNING,
            ),
            Report(
                "5:11",
                "unknown dependency 'arm_core_tools': rosdep has no rule for it, and "
                "it is not a package in the workspace or AMENT_PREFIX_PATH",
                severity=Severity.WARNING,
            ),
            Report(
                "6:11",
                "unknown dependency 'python3-arm-shim': rosdep has no rule for it, and "
                "it is not a package in the workspace or AMENT_PREFIX_PATH",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "neither a key nor a package, without the cache of rosdep",
            {"package.xml": _MANIFEST.format("dotenv")},
            "3:11: unknown dependency 'dotenv': rosdep has no rule for it, and it is not a "
            "package in the workspace or AMENT_PREFIX_PATH; the key is 'python3-dotenv'",
        ),
        Example(
            "the name of a library in the index of Python packages",
            {"package.xml": _MANIFEST.format("python3-pillow")},
            "3:11: unknown dependency 'python3-pillow': rosdep has no rule for it, and it is not "
            "a package in the workspace or AMENT_PREFIX_PATH; the key is 'python3-pil'",
        ),
        Example(
            "a package of another distribution",
            {"package.xml": _MANIFEST.format("turtlebot4_desktop")},
            Report(
                "3:11",
                "unknown dependency 'turtlebot4_desktop': rosdep has no rule for it, "
                "and it is not a package in the workspace or AMENT_PREFIX_PATH; Kilted "
                "lacks it, other distributions have it",
                severity=Severity.WARNING,
            ),
            distro="kilted",
        ),
        Example(
            "a library of older versions of Ubuntu",
            {"package.xml": _MANIFEST.format("ignition-gazebo6")},
            "3:11: rosdep has no rule for 'ignition-gazebo6' on Ubuntu Noble, the system of "
            "Jazzy: it stops",
        ),
        Example(
            "a library of this version of Ubuntu",
            {"package.xml": _MANIFEST.format("ignition-gazebo6")},
            distro="humble",
        ),
        Example(
            "another spelling",
            {"package.xml": _MANIFEST.format("Serial")},
            "3:11: unknown dependency 'Serial': rosdep has no rule for it, and it is not a "
            "package in the workspace or AMENT_PREFIX_PATH; the key is 'python3-serial'",
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
            problem, severity = _problem(package, name)
            if problem:
                cause = f"dependency {name}"
                yield self.report(dependency, problem, cause=cause, severity=severity)


def _problem(package: Package, name: str) -> tuple[str, Severity | None]:
    """Return why rosdep does not resolve a name, if so, and how severe that is."""
    rosdep = package.workspace.rosdep
    is_in_cache = None if rosdep is None else rosdep.resolves(name)
    is_key = is_rosdep_key(name) and not is_released(name)
    if is_key and not has_rosdep_rule(name):
        system = f"Ubuntu {target().fact('ubuntu').capitalize()}, the system of {target().title}"
        pip = f"{name}-pip"
        hint = f"; {pip!r} has one" if is_rosdep_key(pip) and has_rosdep_rule(pip) else ""
        return f"rosdep has no rule for {name!r} on {system}: it stops{hint}", None
    if is_in_cache or (is_in_cache is None and (is_key or _is_of_target(name))):
        return "", None
    hint = _hint(package, name)
    message = (
        f"unknown dependency {name!r}: rosdep has no rule for it, and it is not a package in the "
        f"workspace or AMENT_PREFIX_PATH{hint}"
    )
    is_library = hint.startswith("; the key") and not package.has("CMakeLists.txt")
    is_certain = is_library or not (_PACKAGE.fullmatch(name) or _is_part_of_system(package))
    return message, None if is_certain else Severity.WARNING


def _is_part_of_system(package: Package) -> bool:
    """Return whether packages of the workspace need several unknown ones of one family.

    Whoever installs those, such as ``arm_core_msgs`` and ``arm_core_driver``, may add rules for
    other keys to rosdep.
    """
    unknown: set[str] = set()
    for other in (package, *package.workspace):
        with suppress(ViewError):
            unknown |= declared(other, for_tests=True).unknown
    families = Counter(
        "_".join(words[:2]) for name in unknown if len(words := name.split("_")) > _IN_FAMILY
    )
    return any(number > _IN_FAMILY for number in families.values())


def _is_of_target(name: str) -> bool:
    """Return whether the distribution has a released package."""
    return is_released(name) and has_rosdep_rule(name)


def _is_known(package: Package, name: str) -> bool:
    """Return whether a name is a known package, or another rule reports it."""
    known = (ROS_PACKAGES, ROS1_PACKAGES, OTHER_NAMES)
    if name == package.name or any(name in names for names in known):
        return True
    if why_no_key(package, name) or removed_package(name) is not None or is_fetched(package, name):
        return True
    if (
        similar_package(name)
        or similar_key(name)
        or module_of_key(name)
        or package.workspace.get(name) is not None
        or similar_neighbor(package, name)
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
    if meant := package_of_key(name):
        return f"; the package is {meant!r}"
    rosdep = package.workspace.rosdep
    module = module_of_key(name.removeprefix("python3-"))
    if module is not None:
        return f"; the key is {keys_of_module(module)[0]!r}"
    plain = name.replace("_", "-").lower()
    for guess in (f"python3-{plain.removeprefix('python-')}", plain, f"{plain}-dev"):
        is_in_cache = rosdep is not None and rosdep.resolves(guess)
        if guess != name and (is_in_cache or is_rosdep_key(guess)):
            return f"; the key is {guess!r}"
    return ""
