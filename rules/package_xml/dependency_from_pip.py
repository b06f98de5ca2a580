"""PX029: released packages need nothing from pip."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Rule, Severity


class DependencyFromPip(Rule):
    """A dependency is a key of rosdep that pip installs.

    **Why.** It works for those who build the package; a Debian package cannot depend on it, so
    bloom refuses the release.

    **Fix.** Use the key of the system's package where rosdep has one, such as ``python3-numpy``.

    **Source.** rosdistro, "Review guidelines"; REP-111.
    """

    code = "PX029"
    name = "dependency-from-pip"
    severity = Severity.INFO
    release_refused = "a released package cannot depend on what pip installs"
    examples = (
        Example(
            "a package of the system, and what only tests need",
            {
                "package.xml": "<package>\n  <exec_depend>python3-numpy</exec_depend>\n"
                "  <doc_depend>python3-furo-pip</doc_depend>\n</package>\n"
            },
        ),
        Example(
            "a package of pip",
            {
                "package.xml": "<package>\n  <exec_depend>python3-trimesh-pip</exec_depend>\n"
                "</package>\n"
            },
            "2:16: pip installs 'python3-trimesh-pip': the package cannot be released",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for dependency in package.manifest.dependencies:
            if dependency.kind == "doc_depend" or not dependency.may_be_active:
                continue
            if dependency.name.endswith("-pip"):
                message = f"pip installs {dependency.name!r}: the package cannot be released"
                yield self.report(dependency, message)
