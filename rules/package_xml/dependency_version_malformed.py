"""PX070: the versions that dependencies ask for are numbers."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule, Severity
from scaffold.api.manifest import LIMIT, LIMITS, fits, structure


class DependencyVersionMalformed(Rule):
    """``version_gte`` or alike of a dependency is not one to three numbers.

    **Why.** ``ament_xmllint`` fails under ``colcon test``, and bloom writes a wrong dependency
    into the release.

    **Fix.** Write ``1``, ``1.2`` or ``1.2.3``.

    **Source.** REP-149, "Dependency tags"; the schemas.
    """

    code = "PX070"
    name = "dependency-version-malformed"
    severity = Severity.WARNING
    examples = (
        Example(
            "well-formed",
            {"package.xml": '<package>\n  <depend version_gte="1.2">a</depend>\n</package>\n'},
        ),
        Example(
            "a wildcard",
            {
                "package.xml": '<package format="2">\n'
                '  <depend version_gte="1.x">a</depend>\n</package>\n'
            },
            reports=(Report("package.xml:2:24", 'version_gte="1.x" is not one to three numbers'),),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        found = structure(package)
        for element in found.known:
            if element.tag not in found.dependency_tags:
                continue
            for name, attribute in element.attributes.items():
                if name in LIMITS and not fits(LIMIT, " ".join(attribute.value.split())):
                    message = f'{name}="{attribute.value}" is not one to three numbers'
                    yield self.report(attribute.location, message)
