"""PX029: released packages do not depend on pip packages."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Rule, Severity


class DependencyFromPip(Rule):
    """A dependency is a rosdep key that pip installs.

    **Why.** It works when building from source, but a Debian package cannot depend on it, so bloom
    rejects the release.

    **Fix.** Use the key of a system package if rosdep has one, such as ``python3-numpy``.

    **Source.** rosdistro, "Review guidelines"; REP 111.
    """

    code = "PX029"
    name = "dependency-from-pip"
    severity = Severity.INFO
    release_refused = "a released package cannot depend on pip packages"
    examples = (
        Example(
            "a system package, and a test dependency",
            {
                "package.xml": "<package>\n  <exec_depend>python3-numpy</exec_depend>\n"
                "  <doc_depend>python3-furo-pip</doc_depend>\n</package>\n"
            },
        ),
        Example(
            "a pip package",
            {
                "package.xml": "<package>\n  <exec_depend>python3-trimesh-pip</exec_depend>\n"
                "</package>\n"
            },
            "2:16: 'python3-trimesh-pip' is installed by pip: the package cannot be released",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for dependency in package.manifest.dependencies:
            if dependency.kind == "doc_depend" or not dependency.may_be_active:
                continue
            if dependency.name.endswith("-pip"):
                message = f"{dependency.name!r} is installed by pip: the package cannot be released"
                yield self.report(dependency, message)
