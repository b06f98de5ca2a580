"""Rule classes for the ament codes that concern a whole package.

The codes of Python style are not included: they are checked for all files of a package in one
process.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, ClassVar

from scaffold.ament.codes import CODES, STYLE, AmentCode
from scaffold.check.rules.rule import Example, Rule
from scaffold.diagnostic import Diagnostic
from scaffold.edits import Safety

if TYPE_CHECKING:
    from scaffold.model.package import Package


class AmentRule(Rule):
    """A code of an ament linter, with its documentation in the table."""

    examples: ClassVar[tuple[Example, ...]] = ()
    row: ClassVar[AmentCode]

    @classmethod
    def fix_safety(cls) -> Safety | None:
        """Return the safety in the table."""
        return cls.row.fix

    def check(self, package: Package) -> Iterator[Diagnostic]:
        """Yield the findings of the linter with this code."""
        from scaffold.ament import diagnostics

        return diagnostics(package, self.code)


def _rule(row: AmentCode) -> type[AmentRule]:
    facts = {
        "__doc__": f"{row.summary}.\n\nReported as ``{row.message}``.\n\n{row.documentation}",
        "row": row,
        "code": row.code,
        "name": row.name,
        "severity": row.severity,
        "other_severities": row.other_severities or {},
        "release_refused": row.release_refused,
    }
    return type(row.name, (AmentRule,), facts)


AMENT_RULES: tuple[type[Rule], ...] = tuple(
    _rule(row) for code, row in CODES.items() if code not in STYLE
)
