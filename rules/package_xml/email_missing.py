"""PX072: every maintainer can be written to."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule
from scaffold.api.manifest import structure


class EmailMissing(Rule):
    """A ``<maintainer>`` has no e-mail address.

    **Why.** colcon refuses the manifest: the package is not built, or only as something else.

    **Fix.** Add ``email="..."``. No automatic fix: the tool does not know the address.

    **Source.** REP-149, ``<maintainer>``; ``catkin_pkg/package.py``.
    """

    code = "PX072"
    name = "email-missing"
    examples = (
        Example(
            "an author needs none",
            {
                "package.xml": "<package>\n"
                '  <maintainer email="a@b.org">A</maintainer>\n  <author>B</author>\n</package>\n'
            },
        ),
        Example(
            "a maintainer without",
            {"package.xml": "<package>\n  <maintainer>A</maintainer>\n</package>\n"},
            reports=(Report("package.xml:2:4", "the maintainer 'A' has no email"),),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for element in structure(package).known:
            if element.tag == "maintainer" and element.get("email") is None:
                message = f"the maintainer {element.text!r} has no email"
                yield self.report(element.name_location, message)
