"""PX065: the format of package.xml exists and is that of its schema."""

from __future__ import annotations

import re
from collections.abc import Iterator

from scaffold.api import Diagnostic, Edit, Example, Fix, Package, Report, Rule
from scaffold.api.manifest import FORMATS, XmlModel

LINE = (
    '<?xml-model href="http://download.ros.org/schema/package_format{}.xsd" '
    'schematypens="http://www.w3.org/2001/XMLSchema"?>\n'
)
SCHEMA = r"package_format([0-9]+)\.xsd"


class FormatDiffers(Rule):
    """``format`` is not 1, 2 or 3, or the ``<?xml-model?>`` line names another one.

    **Why.** colcon reads ``format`` and refuses one it does not know; ``ament_xmllint`` reads the
    schema and fails under ``colcon test`` when the two differ. Without ``format`` it is 1.

    **Fix.** Write the same number in both; 3 is the format of ROS 2.

    **Source.** REP-149; ``catkin_pkg/package.py``; ``ament_xmllint/main.py``.
    """

    code = "PX065"
    name = "format-differs"
    examples = (
        Example("the same", {"package.xml": LINE.format(2) + '<package format="2"/>\n'}),
        Example("no schema, format 1", {"package.xml": "<package/>\n"}),
        Example(
            "different",
            {"package.xml": LINE.format(2) + '<package format="3"/>\n'},
            reports=(
                Report(
                    "package.xml:1:1",
                    "names the schema of format 2, but <package> has 3",
                    fix="name the schema of format 3",
                ),
            ),
            fixed={"package.xml": LINE.format(3) + '<package format="3"/>\n'},
        ),
        Example(
            "none, so 1",
            {"package.xml": LINE.format(3) + "<package/>\n"},
            reports=(
                Report(
                    "package.xml:2:2",
                    "no format: that is format 1, but the schema named is format 3",
                ),
            ),
        ),
        Example(
            "a format that does not exist",
            {"package.xml": LINE.format(3) + '<package format="4"/>\n'},
            reports=(
                Report("package.xml:2:18", 'format="4" does not exist: there are 1, 2 and 3'),
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        manifest = package.manifest
        declared, root = manifest.declared_format, manifest.root
        if declared is not None and declared not in map(str, FORMATS):
            at = root.attributes["format"].location
            yield self.report(at, f'format="{declared}" does not exist: there are 1, 2 and 3')
            return
        for model in manifest.xml_models:
            named = re.search(SCHEMA, model.href or "")
            if named is None or named[1] == (declared or "1"):
                continue
            if declared is None:
                message = f"no format: that is format 1, but the schema named is format {named[1]}"
                yield self.report(root.name_location, message)
            else:
                message = f"names the schema of format {named[1]}, but <package> has {declared}"
                yield self.report(model, message, _fix(package, model, declared))


def _fix(package: Package, model: XmlModel, declared: str) -> Fix:
    source, instruction = package.manifest.source, model.instruction
    start = source.text.index("package_format", instruction.start) + len("package_format")
    end = source.text.index(".xsd", start)
    return Fix(f"name the schema of format {declared}", (Edit(source.path, start, end, declared),))
