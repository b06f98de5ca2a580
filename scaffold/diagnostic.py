"""A finding of a rule: its location, message, severity and fix."""

from __future__ import annotations

from enum import Enum, IntEnum

from scaffold.edits import Fix
from scaffold.record import NamedTuple
from scaffold.source import Location


class Severity(Enum):
    """The severity of a diagnostic."""

    ERROR = "error"
    """It breaks at build, run, test or release."""
    WARNING = "warning"
    """The style guide says otherwise."""
    INFO = "info"
    """Advice."""


class Effect(IntEnum):
    """The effect of a flaw; the screen sorts findings of one severity by it."""

    STOPS_BUILD = 0
    """A file is not read, or the package is not built."""
    STOPS_PROGRAM = 1
    """A program stops, or does the wrong thing."""
    IGNORED = 2
    """What is written has no effect; the program goes on."""
    SPOILS_INSTALL = 3
    """What is built or installed is incomplete; the program that needs it stops later."""
    MISSING_ELSEWHERE = 4
    """A program stops on a machine that lacks a package."""
    DECLARED_WRONG = 5
    """The manifest, a name or a test says something wrong; nothing stops here."""
    UNPUBLISHABLE = 6
    """Nothing stops, but a license or a notice is missing that others need."""


class Diagnostic(NamedTuple):
    """A finding at a location."""

    code: str
    name: str
    severity: Severity
    location: Location
    message: str
    fix: Fix | None = None
    cause: str = ""
    """The same for findings of one package, of any code, that one edit would end."""
    distributions: tuple[str, ...] = ()
    """Those that it holds for, of several that were checked for; empty for the only one."""

    def __hash__(self) -> int:
        """Leave the fix out: it may be long, and the place and the message differ first."""
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
"""Of one code in one package; a flood of them must not hold the check up."""


def crash_message(subject: str, error: Exception) -> str:
    """Return the message about a defect: what failed, how, and where in our code."""
    trace = error.__traceback__
    while trace is not None and trace.tb_next is not None:
        trace = trace.tb_next
    where = f" (line {trace.tb_lineno} of {trace.tb_frame.f_code.co_name})" if trace else ""
    return f"{subject} failed: {type(error).__name__}: {error}{where}"
