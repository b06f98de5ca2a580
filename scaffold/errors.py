"""What may go wrong through no fault of this tool: one clear line for the user each."""

from __future__ import annotations

TYPE_CHECKING = False  # the one of typing is slow to import, and every start needs this module
if TYPE_CHECKING:
    from scaffold.model.source import Location


class ScaffoldError(Exception):
    """The user's input or environment is at fault; the text says what to do next (exit 2)."""


class ConfigError(ScaffoldError):
    """A configuration file or a flag has a value that cannot be used."""


class ContentError(ScaffoldError):
    """A rule file or a template is broken."""


class InputError(ScaffoldError):
    """A name, a type or a number given by the user is not acceptable."""


class ConflictError(ScaffoldError):
    """Writing would destroy something that exists."""


class LockedError(ScaffoldError):
    """Another process is changing the package."""


class EnvironmentMissingError(ScaffoldError):
    """No ROS 2 environment was found."""


class ViewError(Exception):
    """A view of a package cannot be had; rules that need it stay silent."""


class MissingFileError(ViewError):
    """The package does not have the file that the view is made of."""


class ParseError(ViewError):
    """A file cannot be parsed; reported once, as SC001, at its place."""

    def __init__(self, location: Location, message: str) -> None:
        super().__init__(message)
        self.location = location
        self.message = message


class TooLargeError(ParseError):
    """A file that is too large to be read; reported once, as SC004."""


EXHAUSTED: tuple[type[Exception], ...] = (RecursionError, MemoryError)
"""What code of this tool raises when a file asks for more than there is; the file is at fault."""


def exhausted(error: BaseException) -> str:
    """Return the message for one of ``EXHAUSTED``."""
    if isinstance(error, RecursionError):
        return "nested too deeply"
    return "nested too deeply, or too large for the memory"


class NewerSyntaxError(ViewError):
    """A Python file that only a newer Python than the running one can parse; not a flaw."""

    def __init__(self, location: Location, version: tuple[int, int]) -> None:
        super().__init__(f"needs Python {version[0]}.{version[1]} or newer")
        self.location = location
        self.version = version
