"""PX067: the name of the package is one that every tool takes."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule, Severity
from scaffold.api.manifest import NAME, fits, structure


class NameMalformed(Rule):
    """The name of the package has characters that a name may not have.

    **Why.** ``ament_xmllint`` fails under ``colcon test``. Names with a capital cannot be released,
    and interfaces of such a package cannot be generated. A dash alone is a warning: packages of
    such a name have been released.

    **Fix.** Use lower-case letters, digits and single underscores between them, a letter first.
    No automatic fix: the name stands in other files, too.

    **Source.** REP-144; REP-149, ``<name>``; the schemas.
    """

    code = "PX067"
    name = "name-malformed"
    other_severities = {Severity.WARNING: "only dashes are wrong, and the package has no messages"}
    examples = (
        Example("well-formed", {"package.xml": "<package><name>talker_2</name></package>\n"}),
        Example(
            "a capital and a dash",
            {"package.xml": "<package>\n  <name>Talker-two</name>\n</package>\n"},
            reports=(
                Report(
                    "package.xml:2:9",
                    "the name 'Talker-two' has - in it: only a to z, 0 to 9 and _ are allowed",
                ),
            ),
        ),
        Example(
            "a dash",
            {"package.xml": "<package><name>the-talker</name></package>\n"},
            reports=(
                Report(
                    "package.xml:1:16",
                    "the name 'the-talker' has - in it: only a to z, 0 to 9 and _ are allowed",
                    severity=Severity.WARNING,
                ),
            ),
        ),
        Example(
            "a dash in the name of a package with messages",
            {"package.xml": "<package><name>the-msgs</name></package>\n", "msg/Beat.msg": ""},
            reports=(
                Report(
                    "package.xml:1:16",
                    "the name 'the-msgs' has - in it: only a to z, 0 to 9 and _ are allowed",
                ),
            ),
        ),
        Example(
            "two underscores",
            {"package.xml": "<package>\n  <name>talker__two</name>\n</package>\n"},
            reports=(
                Report(
                    "package.xml:2:9",
                    "the name 'talker__two' has an underscore at its end or two in a row",
                ),
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for element, name in structure(package).values("name"):
            if not fits(NAME, name):
                is_plain = fits(NAME, name.replace("-", "_")) and not package.glob("msg/*.msg")
                severity = Severity.WARNING if is_plain else Severity.ERROR
                message = f"the name {name!r} {_reason(name)}"
                yield self.report(element.text_location, message, severity=severity)


def _reason(name: str) -> str:
    if not name:
        return "is empty"
    wrong = sorted({c for c in name if not (c.isascii() and (c.isalnum() or c == "_"))})
    if wrong:
        shown = " ".join("a blank" if c == " " else c for c in wrong)
        return f"has {shown} in it: only a to z, 0 to 9 and _ are allowed"
    if name != name.lower():
        return f"has capitals in it: write {name.lower()!r}"
    if not name[0].isalpha():
        return "does not begin with a letter"
    return "has an underscore at its end or two in a row"
