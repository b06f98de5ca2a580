"""PX073: e-mail addresses in package.xml look like addresses."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule
from scaffold.api.manifest import EMAIL, collapse, fits, structure


class EmailMalformed(Rule):
    """What stands as the e-mail address of a maintainer or author is no address.

    **Why.** colcon refuses the manifest: the package is not built, or only as something else.

    **Fix.** Write ``name@domain.org``; letters of ASCII, digits and ``-_%+`` only.

    **Source.** REP-149; ``catkin_pkg/package.py``; the schemas.
    """

    code = "PX073"
    name = "email-malformed"
    examples = (
        Example(
            "well-formed",
            {"package.xml": '<package>\n  <author email="a.b@c-d.org">A</author>\n</package>\n'},
        ),
        Example(
            "spelt out",
            {"package.xml": '<package>\n  <author email="a at b.org">A</author>\n</package>\n'},
            reports=(Report("package.xml:2:18", "'a at b.org' is no e-mail address"),),
        ),
        Example(
            "no domain",
            {"package.xml": '<package>\n  <maintainer email="a@b">A</maintainer>\n</package>\n'},
            reports=(Report("package.xml:2:22", "'a@b' is no e-mail address"),),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for element in structure(package).known:
            if element.tag not in {"maintainer", "author"} or element.get("email") is None:
                continue
            attribute = element.attributes["email"]
            if not fits(EMAIL, collapse(attribute.value)):
                yield self.report(attribute.location, f"{attribute.value!r} is no e-mail address")
