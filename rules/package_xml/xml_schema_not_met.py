"""PX051: an XML file fits the schema that it names."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule, Severity

HEAD = '<launch xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance"\n'
USE = HEAD + '        xsi:noNamespaceSchemaLocation="a.xsd">\n'
SCHEMA = """\
<xs:schema xmlns:xs="http://www.w3.org/2001/XMLSchema">
  <xs:element name="launch">
    <xs:complexType>
      <xs:sequence><xs:element name="node" maxOccurs="unbounded"/></xs:sequence>
    </xs:complexType>
  </xs:element>
</xs:schema>
"""


class XmlSchemaNotMet(Rule):
    """An XML file other than package.xml does not fit the schema that it names.

    **Why.** ``ament_xmllint`` validates every file that names a schema, and fails under
    ``colcon test``; also when the schema is not there.

    **Fix.** Correct the file, or the place of the schema. For schemas that are
    not looked at, see PX052.

    **Source.** ``ament_xmllint/main.py``.
    """

    code = "PX051"
    name = "xml-schema-not-met"
    severity = Severity.WARNING
    examples = (
        Example("fits", {"a.xsd": SCHEMA, "a.launch.xml": f"{USE}  <node/>\n</launch>\n"}),
        Example("on the network", {"a.xml": USE.replace("a.xsd", "http://a.org/a") + "</launch>"}),
        Example(
            "does not fit",
            {"a.xsd": SCHEMA, "a.launch.xml": f"{USE}  <nod/>\n</launch>\n"},
            reports=(
                Report(
                    "a.launch.xml:3:1",
                    "does not fit a.xsd: Element 'nod': This element is not expected. "
                    "Expected is ( node )",
                ),
            ),
        ),
        Example(
            "no such schema",
            {"a.launch.xml": f"{USE}</launch>\n"},
            reports=(
                Report("a.launch.xml:1:1", "names the schema a.xsd, but there is no file a.xsd"),
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        from scaffold.api.ament import xmllint

        for verdict in xmllint.verdicts(package):
            if verdict.is_checked:
                yield self.report(verdict.location, verdict.message)
