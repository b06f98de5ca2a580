"""SC: what the tool says about itself and about files that it cannot read."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, ClassVar

from scaffold.check.diagnostic import Diagnostic, Severity
from scaffold.check.rule import Example, Rule

if TYPE_CHECKING:
    from scaffold.model.package import Package


class _Internal(Rule):
    """Raised by the engine itself, not by a look at the package."""

    examples: ClassVar[tuple[Example, ...]] = ()

    def check(self, package: Package) -> Iterator[Diagnostic]:  # noqa: ARG002  the contract
        """Yield nothing: the engine makes these diagnostics."""
        return iter(())


class UnparsableFile(_Internal):
    """A file cannot be parsed.

    **Why.** The build or the start of the node stops at the same place; rules that need the file
    are silent until it is mended.

    **Fix.** Mend the syntax at the place shown.
    """

    code = "SC001"
    name = "unparsable-file"


class RuleCrashed(_Internal):
    """A rule failed: a defect of ros2-scaffold, not of the package.

    **Why.** The other rules still ran, but what this one would have said is unknown.

    **Fix.** Please report it with the message shown; ``--ignore`` switches the rule off.
    """

    code = "SC002"
    name = "rule-crashed"


class UnusedSuppression(_Internal):
    """A ``noqa`` names a code that is not reported on its line.

    **Why.** It hides the next real finding there.

    **Fix.** Remove the code from the comment.
    """

    code = "SC003"
    name = "unused-suppression"
    severity = Severity.WARNING


INTERNAL_RULES: tuple[type[Rule], ...] = (UnparsableFile, RuleCrashed, UnusedSuppression)
