"""PX010: package.xml has an ``<?xml-model ...?>`` line."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Edit, Example, Fix, Package, Report, Rule, Severity

LINE = (
    '<?xml-model href="http://download.ros.org/schema/package_format{}.xsd" '
    'schematypens="http://www.w3.org/2001/XMLSchema"?>'
)


class XmlModelMissing(Rule):
    """package.xml has no ``<?xml-model ...?>`` line.

    **Why.** Without the line, ament_xmllint accepts any content, and colcon ignores an invalid
    package.xml without a warning: the package is not built.

    **Fix.** Add the line for the package format.

    **Source.** ``ament_xmllint/main.py``; ``colcon_ros/package_identification/ros.py``.
    """

    code = "PX010"
    name = "xml-model-missing"
    severity = Severity.WARNING
    examples = (
        Example(
            "with the line",
            {"package.xml": f'<?xml version="1.0"?>\n{LINE.format(3)}\n<package format="3"/>\n'},
        ),
        Example(
            "without the line",
            {"package.xml": '<?xml version="1.0"?>\n<package format="3"/>\n'},
            Report(
                "2:2",
                "no <?xml-model ...?> line: no tool validates package.xml; add it",
                fix="Add the xml-model line",
            ),
            fixed={
                "package.xml": f'<?xml version="1.0"?>\n{LINE.format(3)}\n<package format="3"/>\n'
            },
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        manifest = package.manifest
        if manifest.xml_models:
            return
        fix = None
        start = manifest.root.start
        if manifest.format in (1, 2, 3):
            text = LINE.format(manifest.format) + manifest.source.newline
            fix = Fix("Add the xml-model line", (Edit("package.xml", start, start, text),))
        at = manifest.root.name_location
        yield self.report(
            at, "no <?xml-model ...?> line: no tool validates package.xml; add it", fix
        )
