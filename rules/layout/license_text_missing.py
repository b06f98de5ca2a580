"""LY006: the package or its repository contains the license text."""

from __future__ import annotations

import os
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Rule, Severity

NAMES = ("LICENSE", "LICENCE", "COPYING")
_DEPTH = 5


class LicenseTextMissing(Rule):
    """Neither the package nor its repository has the text of the license.

    **Why.** Most licenses require that their text is included, and rosdistro requires it for the
    first release.

    **Fix.** Add a LICENSE file with the full text.

    **Source.** ROS 2 documentation, "Indexing your packages"; rosdistro review guidelines.
    """

    code = "LY006"
    name = "license-text-missing"
    severity = Severity.INFO
    release_refused = "rosdistro requires the license text"
    examples = (
        Example(
            "a LICENSE file", {"package.xml": "<package/>\n", "setup.py": "", "LICENSE": "..."}
        ),
        Example(
            "no license text",
            {"package.xml": "<package/>\n", "setup.py": ""},
            "package.xml:1:1: no LICENSE file in the package or its repository; add one with the "
            "full text",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        if not package.has("setup.py") and not package.has("CMakeLists.txt"):
            return
        names = [path for path in package.files if "/" not in path]
        if any(name.upper().startswith(NAMES) for name in names):
            return
        if package.place is not None and self._is_above(package, package.place):
            return
        yield self.report(
            package.start_of("package.xml"),
            "no LICENSE file in the package or its repository; add one with the full text",
        )

    def _is_above(self, package: Package, root: str) -> bool:
        """Search the parent directories up to the top of the repository."""
        directory = os.path.abspath(root)
        for _ in range(_DEPTH):
            if package.outside.exists(os.path.join(directory, ".git")):
                return False
            directory = os.path.dirname(directory)
            if package.outside.entries(directory, *NAMES):
                return True
        return False
