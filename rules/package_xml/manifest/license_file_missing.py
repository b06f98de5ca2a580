"""PX006: the license file that package.xml names exists."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Rule

_MANIFEST = '<package format="3">\n  <license file="{}">MIT</license>\n</package>\n'


class LicenseFileMissing(Rule):
    """``<license file="...">`` names a file that does not exist.

    **Why.** bloom does not release the package: ``License file '...' is not found``. The Debian
    package contains the license text.

    **Fix.** Write the path relative to package.xml, or add the file.

    **Source.** REP 149, ``<license>``, attribute ``file``;
    ``bloom/generators/debian/generator.py``.
    """

    code = "PX006"
    name = "license-file-missing"
    examples = (
        Example("an existing file", {"package.xml": _MANIFEST.format("LICENSE"), "LICENSE": "..."}),
        Example(
            "a missing file",
            {"package.xml": _MANIFEST.format("LICENCE"), "LICENSE": "..."},
            "package.xml:2:18: file 'LICENCE' does not exist next to package.xml: bloom stops",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for element in package.manifest.all("license"):
            file = element.attributes.get("file")
            if file is None or package.has(file.value.removeprefix("./")):
                continue
            if file.value.startswith(("..", "/")):
                continue
            yield self.report(
                file, f"file {file.value!r} does not exist next to package.xml: bloom stops"
            )
