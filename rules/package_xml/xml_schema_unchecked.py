"""PX052: an XML file names a schema that is left alone."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule, Severity

HEAD = '<launch xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance"\n'
INCLUDES = """\
<xs:schema xmlns:xs="http://www.w3.org/2001/XMLSchema">
  <xs:include schemaLocation="b.xsd"/>
  <xs:element name="launch"/>
</xs:schema>
"""
FITS = """\
<xs:schema xmlns:xs="http://www.w3.org/2001/XMLSchema">
  <xs:element name="launch"/>
</xs:schema>
"""


def _uses(schema: str) -> str:
    return f'{HEAD}        xsi:noNamespaceSchemaLocation="{schema}"/>\n'


class XmlSchemaUnchecked(Rule):
    """Whether an XML file fits the schema that it names is not checked.

    **Why.** ``ament_xmllint`` validates the file under ``colcon test``, so it may fail there
    although nothing is reported here. A check neither fetches anything nor lets a schema open
    further files, and it ends a schema that takes more than some seconds.

    **Fix.** None is needed; run ``ament_xmllint`` to know. A schema that is one file of the
    package is checked.

    **Source.** ``ament_xmllint/main.py``.
    """

    code = "PX052"
    name = "xml-schema-unchecked"
    severity = Severity.INFO
    examples = (
        Example("one file of the package", {"a.xsd": FITS, "a.launch.xml": _uses("a.xsd")}),
        Example(
            "a schema that includes another",
            {"a.xsd": INCLUDES, "b.xsd": FITS, "a.launch.xml": _uses("a.xsd")},
            reports=(
                Report(
                    "a.launch.xml:1:1",
                    "names the schema 'a.xsd', which is not looked at: it names other files",
                ),
            ),
        ),
        Example(
            "on the network",
            {"a.xml": _uses("https://ros.example.org/launch.xsd")},
            reports=(
                Report(
                    "a.xml:1:1",
                    "names the schema 'https://ros.example.org/launch.xsd', which is not looked "
                    "at: it is on the network",
                ),
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        from scaffold.api.ament import xmllint

        for verdict in xmllint.verdicts(package):
            if not verdict.is_checked:
                yield self.report(verdict.location, verdict.message)
