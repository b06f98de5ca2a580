"""SC codes: findings about the tool, its configuration, and unreadable files."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, ClassVar

from scaffold.check.rules.rule import Example, Rule
from scaffold.diagnostic import Diagnostic, Effect, Severity

if TYPE_CHECKING:
    from scaffold.model.package import Package


class _Internal(Rule):
    """A finding of the engine itself, not of a check of the package."""

    examples: ClassVar[tuple[Example, ...]] = ()

    def check(self, package: Package) -> Iterator[Diagnostic]:  # noqa: ARG002  the contract
        """Yield nothing, as the engine creates these diagnostics."""
        return iter(())


class UnparsableFile(_Internal):
    """A file cannot be parsed.

    **Why.** The build or the node stops at the same place; rules that need the file are skipped
    until it is fixed.

    **Fix.** Correct the syntax at the place shown.
    """

    code = "SC001"
    name = "unparsable-file"
    effect = Effect.STOPS_BUILD
    other_severities: ClassVar[dict[Severity, str]] = {
        Severity.WARNING: "the file is not UTF-8, which CMake and compilers accept: only "
        "this tool cannot check it; or the error is outside of the <robot> element of a URDF "
        "file, which robot_state_publisher ignores"
    }


class RuleCrashed(_Internal):
    """A rule crashed: a bug in ros2-scaffold, not in the package.

    **Why.** The other rules still ran, but the findings of this one are unknown.

    **Fix.** Report it with the message shown; ``--ignore`` disables the rule.
    """

    code = "SC002"
    name = "rule-crashed"


class UnusedSuppression(_Internal):
    """A ``noqa`` comment names a code that is not reported on its line.

    **Why.** It would hide a real finding there later.

    **Fix.** Remove the code from the comment.
    """

    code = "SC003"
    name = "unused-suppression"
    severity = Severity.WARNING


class FileTooLarge(_Internal):
    """A file is too large to be checked.

    **Why.** Mistakes in it stay undetected. To keep a single file from stalling the check, code is
    read up to 500 kB and 100 000 tokens, CMakeLists.txt up to 250 kB and 30 000 tokens,
    package.xml, setup.py and setup.cfg up to 100 kB and 20 000 tokens, data such as YAML up to
    1 MB, and a line of code up to 20 kB: 1.5 to 20 times the largest files and lines of 800
    public packages. Python code is read up to a syntax tree of 60 000 nodes, and up to 4 000
    statements in one block: 3 and 16 times the most that 22 public repositories have.

    **Fix.** Split the file, or keep generated code out of the package's sources.
    """

    code = "SC004"
    name = "file-too-large"
    severity = Severity.WARNING


class TooManyFindings(_Internal):
    """One code is reported so often that the rest is not shown.

    **Why.** Thousands of copies of one message hide the other findings, so only the first ones are
    shown.

    **Fix.** Fix the findings shown, by hand or with ``--fix``, and check again.
    """

    code = "SC005"
    name = "too-many-findings"
    severity = Severity.WARNING


class StyleNotJudged(_Internal):
    """The configuration that a package passes to a linter of ament is not used.

    **Why.** Style is checked as the tests of the package check it. Here, the linter rejects its
    configuration, or its arguments are only known while the tests run; so ament's default
    configuration is used, or the option in question is ignored.

    **Fix.** Correct the configuration, or pass it as a literal path.
    """

    code = "SC006"
    name = "style-not-judged"
    severity = Severity.INFO


class PackageOfRos1(_Internal):
    """The package is for ROS 1: it is built with catkin.

    **Why.** Jazzy has no catkin: colcon stops at ``find_package(catkin)``, and nodes at
    ``import rospy``. No other finding would help before the package is migrated, so none is
    reported.

    **Fix.** Migrate the package, or put an empty file ``COLCON_IGNORE`` next to its package.xml.

    **Source.** ROS 2 documentation, "Migrating packages".
    """

    code = "SC007"
    name = "package-of-ros1"
    other_severities: ClassVar[dict[Severity, str]] = {
        Severity.WARNING: "the packages of ROS 2 are in a directory src/ without this one, so that "
        "colcon does not find it"
    }
    effect = Effect.SPOILS_INSTALL


class LicenseNotAllowed(_Internal):
    """A package has a license that the configuration does not allow.

    **Why.** The key ``licenses`` lists the licenses under which packages of this project may be
    published.

    **Fix.** Choose one of them, or add the license to the configuration.
    """

    code = "SC008"
    name = "license-not-allowed"

    def check(self, package: Package) -> Iterator[Diagnostic]:
        """Yield the licenses that are not allowed; raises ViewError without a manifest."""
        from scaffold.model.manifest.spdx import spdx_of

        allowed = package.workspace.policy.licenses
        for element in package.manifest.all("license") if allowed else ():
            if {element.text, *spdx_of(element.text)}.isdisjoint(allowed):
                names = ", ".join(allowed)
                message = f"license {element.text!r} is not allowed here; allowed: {names}"
                yield self.report(element.text_location, message)


INTERNAL_RULES: tuple[type[Rule], ...] = (
    UnparsableFile,
    RuleCrashed,
    UnusedSuppression,
    FileTooLarge,
    TooManyFindings,
    StyleNotJudged,
    PackageOfRos1,
    LicenseNotAllowed,
)
