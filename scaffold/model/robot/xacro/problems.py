"""Errors that xacro would report, and how complete the expansion is."""

from __future__ import annotations

from typing import TYPE_CHECKING

from scaffold.formats.xml import Attribute, Element
from scaffold.record import NamedTuple
from scaffold.source import Location

if TYPE_CHECKING:
    from scaffold.model.package import Package
    from scaffold.model.robot.files import RobotFile


class Undefined(NamedTuple):
    """An undefined name."""

    kind: str
    """``macro``, ``property``, ``block``, ``argument``, ``command``, ``expression`` or ``tag``."""
    name: str
    location: Location
    known: tuple[str, ...]
    """The names defined there."""


class Misfit(NamedTuple):
    """A call that does not match its macro."""

    kind: str
    """``unknown``, ``missing``, ``block missing``, ``block unused`` or ``condition``."""
    macro: str
    name: str
    location: Location
    known: tuple[str, ...]


class Problems:
    """The problems of a file, and how complete its expansion is.

    Args:
        file: The file.
        package: The checked package; the file may include those of other packages.
        is_open: Whether names may be defined elsewhere.
    """

    def __init__(self, file: RobotFile, package: Package, *, is_open: bool) -> None:
        self.undefined: list[Undefined] = []
        self.misfits: list[Misfit] = []
        self.is_open = is_open
        """Whether an unknown file is included."""
        self.is_partial = False
        """Whether parts are missing, or may be."""
        self._package = package
        self._file = file

    def note(
        self, kind: str, name: str, user: RobotFile, location: Location, known: tuple[str, ...]
    ) -> None:
        """Record an undefined name, and the file that uses it."""
        is_ours = user.package is self._package and user.is_xacro
        if is_ours and not self.is_open and self._file.is_xacro:
            self.undefined.append(Undefined(kind, name, location, known))

    def misfit(
        self,
        kind: str,
        macro: str,
        name: str,
        user: RobotFile,
        at: Attribute | Element,
        known: tuple[str, ...] = (),
    ) -> None:
        """Record an invalid call, and its file."""
        if user.package is self._package:
            place = at.name_location if isinstance(at, Element) else at.location
            self.misfits.append(Misfit(kind, macro, name, place, known))
        else:
            self.is_partial = True
