"""PX021: what is imported is declared here, not only by a dependency of a dependency."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Fix, Package, Rule, Severity
from scaffold.model.needs import declared, needs


class ImportDeclaredAlongTheWay(Rule):
    """An imported package is there only because another dependency needs it.

    **Why.** It works until that other package no longer needs it.

    **Fix.** Declare what you import.

    **Source.** ROS 2 documentation, "ament_cmake user documentation": no transitive dependencies;
    REP-149, ``<exec_depend>``.
    """

    code = "PX021"
    name = "import-declared-along-the-way"
    severity = Severity.INFO
    examples = (
        Example(
            "declared itself",
            {
                "package.xml": '<package format="3">\n'
                "  <exec_depend>launch</exec_depend>\n"
                "  <exec_depend>launch_ros</exec_depend>\n"
                "</package>\n",
                "launch/talk.launch.py": "import launch\nimport launch_ros\n",
            },
        ),
        Example(
            "launch comes with launch_ros",
            {
                "package.xml": '<package format="3">\n'
                "  <exec_depend>launch_ros</exec_depend>\n"
                "</package>\n",
                "launch/talk.launch.py": "import launch\nimport launch_ros\n",
            },
            at=("package.xml:2",),
            fixed={
                "package.xml": '<package format="3">\n'
                "  <exec_depend>launch</exec_depend>\n"
                "  <exec_depend>launch_ros</exec_depend>\n"
                "</package>\n"
            },
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        manifest = package.manifest
        if manifest.format == 1:
            return
        for need in needs(package):
            there = declared(package, for_tests=need.for_tests)
            if there.direct.intersection(need.keys):
                continue
            key = next((key for key in need.keys if key in there.along), None)
            if key is None or not manifest.dependencies:
                continue
            tag = "test_depend" if need.for_tests else "exec_depend"
            at = need.location
            message = (
                f"{at.path}:{at.line} imports {need.module!r}, which is there only because another "
                f"dependency needs it; declare <{tag}>{key}</{tag}> as well"
            )
            fix = Fix(f"declare {key}", (manifest.insert(tag, key),))
            yield self.report(manifest.dependencies[-1].element.name_location, message, fix)
