"""PX075: what package.xml gives as a URL is one."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule, Severity
from scaffold.api.manifest import is_uri, structure


class UrlMalformed(Rule):
    """The text of a ``<url>`` is not a URL.

    **Why.** ``ament_xmllint`` fails under ``colcon test``, and the link leads nowhere.

    **Fix.** Correct the URL: a port is a number, ``%`` begins two hexadecimal digits.

    **Source.** REP-149, ``<url>``; the schemas, type ``anyURI``.
    """

    code = "PX075"
    name = "url-malformed"
    severity = Severity.WARNING
    examples = (
        Example("a URL", {"package.xml": "<package><url>http://a.org:80/b#c</url></package>\n"}),
        Example(
            "no port",
            {"package.xml": "<package>\n  <url>http://a.org:port/b</url>\n</package>\n"},
            reports=(Report("package.xml:2:8", "'http://a.org:port/b' is not a URL"),),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for element, url in structure(package).values("url"):
            if not is_uri(url):
                yield self.report(element.text_location, f"{url!r} is not a URL")
