"""PX080: imported packages are declared, even if they are transitive dependencies."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Fix, Package, Report, Rule, Severity
from scaffold.api.catalog import similar_package, transitive_dependencies
from scaffold.api.manifest import declared, required_packages

_INTERFACES = ("_msgs", "_srvs")
_MANIFEST = '<package format="3">\n  <name>talker</name>\n{}</package>\n'
_FILES = {"talker/__init__.py": "", "talker/node.py": "import rclpy\n"}
_LAUNCH = "  <exec_depend>launch_ros</exec_depend>\n"
_RCLPY = "  <exec_depend>rclpy</exec_depend>\n"


class ImportDeclaredByOthers(Rule):
    """rclpy or messages are imported, but only declared by a dependency.

    **Why.** It works until that package removes the dependency. REP 149 requires a declaration of
    every package that the code uses directly.

    **Fix.** Declare it with ``<exec_depend>``.

    **Source.** REP 149, ``exec_depend``; ROS 2 documentation, "Managing dependencies with rosdep".
    """

    code = "PX080"
    name = "import-declared-by-others"
    severity = Severity.INFO
    examples = (
        Example("declared", {**_FILES, "package.xml": _MANIFEST.format(_LAUNCH + _RCLPY)}),
        Example(
            "transitive dependency of launch_ros",
            {**_FILES, "package.xml": _MANIFEST.format(_LAUNCH)},
            Report(
                "package.xml:3:4",
                "talker/node.py:1 imports 'rclpy', which only launch_ros declares; add "
                "<exec_depend>rclpy</exec_depend>",
                fix="Declare rclpy",
            ),
            fixed={"package.xml": _MANIFEST.format(_LAUNCH + _RCLPY)},
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        manifest = package.manifest
        for need in required_packages(package):
            dependencies = declared(package, for_tests=need.for_tests)
            if need.for_tests or any(key in dependencies.direct for key in need.keys):
                continue
            if not (need.module == "rclpy" or need.module.endswith(_INTERFACES)):
                continue
            along = [key for key in need.keys if key in dependencies.along]
            if not along or not manifest.dependencies:
                continue
            if any(similar_package(item) == along[0] for item in dependencies.direct):
                continue  # misspelled, reported by another rule
            if manifest.left_out(need.keys, "run"):
                continue  # its condition is the problem
            tag = "run_depend" if manifest.format == 1 else "exec_depend"
            by = next(
                (
                    item
                    for item in sorted(dependencies.direct)
                    if along[0] in transitive_dependencies({item})
                ),
                "",
            )
            message = (
                f"{need.location.path}:{need.location.line} imports {need.module!r}, which only "
                f"{by or 'another package'} declares; add <{tag}>{along[0]}</{tag}>"
            )
            last = manifest.dependencies[-1].element
            fix = Fix(f"Declare {along[0]}", (manifest.insert(tag, along[0]),))
            yield self.report(last.name_location, message, fix)
