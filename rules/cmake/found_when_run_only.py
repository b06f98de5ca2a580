"""CM107: what CMake finds is there when the package is built."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import (
    Diagnostic,
    Effect,
    Example,
    Fix,
    Package,
    Report,
    Rule,
    Severity,
    ViewError,
)
from scaffold.api.catalog import ROS_PACKAGES, transitive_dependencies

_MANIFEST = '<package format="3">\n  <name>talker</name>\n{}</package>\n'
_LISTS = "project(talker)\nfind_package(std_msgs REQUIRED)\n"
_EXEC = "  <exec_depend>std_msgs</exec_depend>\n"


class FoundWhenRunOnly(Rule):
    """``find_package`` looks for a package that the manifest only declares as a run dependency.

    **Why.** The build farm, and ``rosdep install --dependency-types build``, leave it out, and
    CMake stops. Where everything is installed, as ``rosdep install`` alone does, it builds.

    **Fix.** Add a ``<build_depend>``, or write ``<depend>`` instead of the ``<exec_depend>``. A
    package of Python code alone need not be found at all.

    **Source.** REP-149, ``exec_depend``; bloom, whose ``Build-Depends`` are those of
    ``buildtool_depend``, ``build_depend``, ``depend`` and ``test_depend``.
    """

    code = "CM107"
    name = "found-when-run-only"
    severity = Severity.WARNING
    effect = Effect.STOPS_BUILD
    release_refused = "the build farm does not install the package before it builds"
    examples = (
        Example(
            "for the build",
            {
                "package.xml": _MANIFEST.format("  <depend>std_msgs</depend>\n"),
                "CMakeLists.txt": _LISTS,
            },
        ),
        Example(
            "transitive dependency of a build dependency",
            {
                "package.xml": _MANIFEST.format("  <depend>sensor_msgs</depend>\n" + _EXEC),
                "CMakeLists.txt": _LISTS,
            },
        ),
        Example(
            "where it is there",
            {
                "package.xml": _MANIFEST.format(_EXEC),
                "CMakeLists.txt": "project(talker)\nfind_package(std_msgs)\n",
            },
        ),
        Example(
            "for running",
            {"package.xml": _MANIFEST.format(_EXEC), "CMakeLists.txt": _LISTS},
            Report(
                "package.xml:3:3",
                "<exec_depend> 'std_msgs' is not installed when the package is "
                "built, but CMakeLists.txt, line 2 finds it; add <build_depend>",
                fix="add a <build_depend> of std_msgs",
            ),
            fixed={
                "package.xml": _MANIFEST.format("  <build_depend>std_msgs</build_depend>\n" + _EXEC)
            },
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        manifest = package.manifest
        kinds: dict[str, set[str]] = {}
        for declared in manifest.dependencies:
            kinds.setdefault(declared.name, set()).add(declared.kind)
        only = {name for name, item in kinds.items() if item == {"exec_depend"}}
        along = _there(package) if only else set()
        for found_package in package.cmake.found_packages:
            name = found_package.name
            if (
                name not in only
                or name in along
                or not found_package.required
                or found_package.command.blocks
            ):
                continue
            if name not in ROS_PACKAGES and package.workspace.get(name) is None:
                continue
            only.remove(name)
            element = next(
                dependency for dependency in manifest.dependencies if dependency.name == name
            ).element
            message = (
                f"<exec_depend> {name!r} is not installed when the package is built, but "
                f"CMakeLists.txt, line {found_package.location.line} finds it; add <build_depend>"
            )
            fix = Fix(f"add a <build_depend> of {name}", (manifest.insert("build_depend", name),))
            yield self.report(element, message, fix)


def _there(package: Package) -> set[str]:
    """Return the transitive dependencies of those for the build and the tests."""
    manifest = package.manifest
    result: set[str] = set()
    pending = [
        *manifest.build_names,
        *manifest.test_names,
        *(
            dependency.name
            for dependency in manifest.dependencies
            if dependency.kind.startswith("buildtool")
        ),
    ]
    while pending:
        name = pending.pop()
        if name not in result:
            result.add(name)
            neighbour = package.workspace.get(name)
            try:
                pending += neighbour.manifest.run_names if neighbour is not None else ()
            except ViewError:
                continue
    # A package with messages depends on what is needed to use them.
    return result | transitive_dependencies(result) | {"rosidl_default_runtime"}
