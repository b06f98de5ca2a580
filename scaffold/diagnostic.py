"""A finding of a rule: its location, message, severity and fix."""

from __future__ import annotations

from enum import Enum, IntEnum

from scaffold.edits import Fix
from scaffold.record import NamedTuple
from scaffold.source import Location


class Severity(Enum):
    """The severity of a diagnostic."""

    ERROR = "error"
    """Something breaks at build, run, test or release."""
    WARNING = "warning"
    """The style guide says otherwise."""
    INFO = "info"
    """Advice."""


class Effect(IntEnum):
    """The effect of a flaw; the screen sorts findings of one severity by it.

    The order is that of somebody who downloads the package: rosdep, build, start, use, test.
    """

    STOPS_ROSDEP = 0
    """rosdep stops at a name, so that it installs nothing for any package."""
    STOPS_BUILD = 1
    """The package is not built, maybe only on machines without a dependency."""
    STOPS_PACKAGE = 2
    """No program of the package starts."""
    STOPS_START = 3
    """A program or a launch file does not start, maybe only on machines without a dependency."""
    STOPS_PROGRAM = 4
    """A program stops or hangs, maybe only later or in some cases."""
    SPOILS_INSTALL = 5
    """The installation is incomplete; a program that needs it stops later."""
    WRONG_BEHAVIOR = 6
    """A program does the wrong thing, such as ignoring a setting."""
    INFERRED = 7
    """A program stops or does the wrong thing, according to inferred types and values."""
    DECLARED_WRONG = 8
    """The manifest, a name or a test is wrong; nothing stops here, at least in a plain build."""
    UNPUBLISHABLE = 9
    """Nothing stops, but a license or a notice is missing that others need."""
    STYLE = 10
    """Only a linter of CMake files reports how the file is written."""


class Diagnostic(NamedTuple):
    """A finding at a location."""

    code: str
    name: str
    severity: Severity
    location: Location
    message: str
    fix: Fix | None = None
    cause: str = ""
    """Shared by findings of one package, of any code, that one edit would resolve."""
    distributions: tuple[str, ...] = ()
    """The affected distributions, if several were checked for; empty for a single one."""
    effect: Effect | None = None
    """The effect, if it is not the usual one of its rule."""

    def __hash__(self) -> int:
        """Ignore the fix, which may be long, while place and message differ first."""
        return hash((self.location, self.message))

    @property
    def text(self) -> str:
        """The message, with its distributions if they do not include all targets."""
        names = ", ".join(self.distributions)
        return f"{self.message} ({names})" if names else self.message

    @property
    def sort_key(self) -> tuple[str, int, int, str, str]:
        """Reading order: file, line, column, then code and message."""
        at = self.location
        return at.path, at.line, at.column, self.code, self.message


MAX_FINDINGS = 5000
"""The maximum number per code and package, so that a flood does not stall the check."""


def crash_message(subject: str, error: Exception) -> str:
    """Return the message about a defect: what failed, the error, and the place in our code."""
    trace = error.__traceback__
    while trace is not None and trace.tb_next is not None:
        trace = trace.tb_next
    where = f" (line {trace.tb_lineno} of {trace.tb_frame.f_code.co_name})" if trace else ""
    return f"{subject} failed: {type(error).__name__}: {error}{where}"
