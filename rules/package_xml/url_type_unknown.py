"""PX069: a url in package.xml has a type that is known."""

from __future__ import annotations

from collections.abc import Iterator
from difflib import get_close_matches

from scaffold.api import Diagnostic, Example, Package, Report, Rule, Severity
from scaffold.api.manifest import URL_TYPES, collapse, structure


class UrlTypeUnknown(Rule):
    """``<url type>`` is none of website, bugtracker and repository.

    **Why.** ``ament_xmllint`` fails under ``colcon test``, and the index of packages shows no
    link.

    **Fix.** Use one of the three; without ``type`` it is a website.

    **Source.** REP-149, ``<url>``; the schemas.
    """

    code = "PX069"
    name = "url-type-unknown"
    severity = Severity.WARNING
    examples = (
        Example(
            "known",
            {"package.xml": '<package>\n  <url type="website">http://a.org</url>\n</package>\n'},
        ),
        Example(
            "unknown",
            {"package.xml": '<package>\n  <url type="homepage">http://a.org</url>\n</package>\n'},
            reports=(
                Report(
                    "package.xml:2:14",
                    "the url type 'homepage' is not known, only website, bugtracker, repository",
                ),
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for element in structure(package).known:
            if element.tag != "url" or element.get("type") is None:
                continue
            attribute = element.attributes["type"]
            kind = collapse(attribute.value)
            if kind not in URL_TYPES:
                near = get_close_matches(kind, URL_TYPES, n=1)
                hint = f": {near[0]} is" if near else f", only {', '.join(URL_TYPES)}"
                yield self.report(attribute.location, f"the url type {kind!r} is not known{hint}")
