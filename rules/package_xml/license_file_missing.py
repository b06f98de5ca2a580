"""PX006: the license file that the manifest names exists."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Rule

_MANIFEST = '<package format="3">\n  <license file="{}">MIT</license>\n</package>\n'


class LicenseFileMissing(Rule):
    """``<license file="...">`` names a file that does not exist.

    **Why.** bloom makes no release: ``License file '...' is not found``. The text of the license
    is part of the package for Debian.

    **Fix.** Write the path relative to package.xml, or add the file.

    **Source.** REP-149, ``<license>``, attribute ``file``;
    ``bloom/generators/debian/generator.py``.
    """

    code = "PX006"
    name = "license-file-missing"
    examples = (
        Example("there", {"package.xml": _MANIFEST.format("LICENSE"), "LICENSE": "..."}),
        Example(
            "not there",
            {"package.xml": _MANIFEST.format("LICENCE"), "LICENSE": "..."},
            "package.xml:2:18: there is no file 'LICENCE' next to package.xml",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for element in package.manifest.all("license"):
            file = element.attributes.get("file")
            if file is None or package.has(file.value.removeprefix("./")):
                continue
            if file.value.startswith(("..", "/")):
                continue
            yield self.report(file, f"there is no file {file.value!r} next to package.xml")
