"""PX068: the version of the package has three numbers."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule
from scaffold.api.manifest import VERSION, fits, structure


class VersionMalformed(Rule):
    """The version of the package is not three numbers with dots between them.

    **Why.** colcon refuses the manifest: the package is not built, or only as something else. A
    number with a leading zero fails in ``ament_xmllint`` only.

    **Fix.** Write ``MAJOR.MINOR.PATCH`` such as ``0.1.0``.

    **Source.** REP-149, ``<version>``; ``catkin_pkg/package.py``.
    """

    code = "PX068"
    name = "version-malformed"
    examples = (
        Example("well-formed", {"package.xml": "<package><version>0.1.0</version></package>\n"}),
        Example(
            "two numbers",
            {"package.xml": "<package>\n  <version>0.1</version>\n</package>\n"},
            reports=(Report("package.xml:2:12", "the version '0.1' is not MAJOR.MINOR.PATCH"),),
        ),
        Example(
            "a suffix",
            {"package.xml": "<package>\n  <version>0.1.0-rc1</version>\n</package>\n"},
            reports=(
                Report("package.xml:2:12", "the version '0.1.0-rc1' is not MAJOR.MINOR.PATCH"),
            ),
        ),
        Example(
            "a leading zero",
            {"package.xml": "<package>\n  <version>0.01.0</version>\n</package>\n"},
            reports=(Report("package.xml:2:12", "the version '0.01.0' has a leading zero"),),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for element, version in structure(package).values("version"):
            if not fits(VERSION, version):
                said = "has a leading zero" if _has_zero(version) else "is not MAJOR.MINOR.PATCH"
                yield self.report(element.text_location, f"the version {version!r} {said}")


def _has_zero(version: str) -> bool:
    return fits(r"[0-9]+\.[0-9]+\.[0-9]+", version)
