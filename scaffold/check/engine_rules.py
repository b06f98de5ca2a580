"""SC: what the tool says about itself and about files that it cannot read."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, ClassVar

from scaffold.check.rule import Example, Rule
from scaffold.diagnostic import Diagnostic, Severity

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


class FileTooLarge(_Internal):
    """A file is too large to be checked.

    **Why.** What is wrong in it stays unknown. So that no file can hold the check up, code is
    read up to 500 kB and 100 000 words and signs, CMakeLists.txt up to 250 kB and 30 000,
    package.xml, setup.py and setup.cfg up to 100 kB and 20 000, data such as YAML up to 1 MB, and
    a line of code up to 20 kB: one and a half to twenty times the largest files and lines of 800
    public packages.

    **Fix.** Split the file, or keep generated code out of the package's sources.
    """

    code = "SC004"
    name = "file-too-large"
    severity = Severity.WARNING


class TooManyFindings(_Internal):
    """One code is found so often that the search for more ends.

    **Why.** Nobody reads five thousand lines that say the same; what is wrong behind the last
    one of them is not shown.

    **Fix.** Mend what is shown, by hand or with ``--fix``, and check again.
    """

    code = "SC005"
    name = "too-many-findings"
    severity = Severity.WARNING


INTERNAL_RULES: tuple[type[Rule], ...] = (
    UnparsableFile,
    RuleCrashed,
    UnusedSuppression,
    FileTooLarge,
    TooManyFindings,
)
