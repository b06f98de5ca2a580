"""PX062: package.xml has the elements that every manifest has."""

from __future__ import annotations

from collections.abc import Iterator
from difflib import get_close_matches

from scaffold.api import Diagnostic, Example, Package, Report, Rule
from scaffold.api.manifest import REQUIRED, structure

ALL = """\
<package format="3">
  <name>talker</name>
  <version>1.0.0</version>
  <description>Talks.</description>
  <maintainer email="a@b.org">A</maintainer>
  <license>Apache-2.0</license>
</package>
"""


class ElementMissing(Rule):
    """package.xml lacks a name, version, description, maintainer or license.

    **Why.** colcon refuses the manifest: the package is not built, or only as something else.

    **Fix.** Add the element. No automatic fix: the author has to say what is in it.

    **Source.** REP-149, "Required tags"; ``catkin_pkg/package.py``.
    """

    code = "PX062"
    name = "element-missing"
    examples = (
        Example("all there", {"package.xml": ALL}),
        Example(
            "no licence, no maintainer",
            {
                "package.xml": "".join(
                    line
                    for line in ALL.splitlines(keepends=True)
                    if "maintainer" not in line and "license" not in line
                )
            },
            reports=(
                Report(
                    "package.xml:1:2", "no <license>: every manifest has one, behind <maintainer>"
                ),
                Report(
                    "package.xml:1:2",
                    "no <maintainer>: every manifest has one, behind <description>",
                ),
            ),
        ),
        Example(
            "misspelt: said by another rule",
            {"package.xml": ALL.replace("license", "licence")},
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        found = structure(package)
        misspelt = {
            name
            for unknown in found.unknown
            for name in get_close_matches(unknown.element.tag, found.sections, n=1, cutoff=0.75)
        }
        for tag in found.missing:
            if tag not in misspelt:
                behind = REQUIRED[: REQUIRED.index(tag)]
                where = f"behind <{behind[-1]}>" if behind else "at the beginning"
                message = f"no <{tag}>: every manifest has one, {where}"
                yield self.report(found.root.name_location, message)
