"""The contract of a rule file: one class with metadata, examples and ``check``."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, ClassVar, Protocol

from scaffold.check.diagnostic import Diagnostic, Fix, Severity
from scaffold.model.source import Location

if TYPE_CHECKING:
    from scaffold.model.package import Package


class Located(Protocol):
    """Anything that knows its place: an element, a command, a location itself."""

    @property
    def location(self) -> Location:
        """The place."""


class Example:
    """A package and what a rule says about it: a test and a part of the documentation.

    Args:
        title: What it shows.
        files: Text by path; a path ending in ``/`` is an empty directory.
        at: The exact places, ``path:line``, in reading order; none for an accepted package.
        fixed: The files that the fix changes or adds; ``None`` when there is no fix.
        executable: The files with an executable bit.
        neighbours: Other packages of the workspace: files by path, by package directory.
        rosdep_keys: What rosdep resolves; ``None`` for a machine without its cache.
    """

    def __init__(
        self,
        title: str,
        files: Mapping[str, str],
        *,
        at: tuple[str, ...] = (),
        fixed: Mapping[str, str] | None = None,
        executable: tuple[str, ...] = (),
        neighbours: Mapping[str, Mapping[str, str]] | None = None,
        rosdep_keys: tuple[str, ...] | None = None,
    ) -> None:
        self.title = title
        self.files = files
        self.at = at
        self.fixed = fixed
        self.executable = executable
        self.neighbours = neighbours or {}
        self.rosdep_keys = rosdep_keys


class Rule:
    """A rule; its docstring says what the flaw is, **Why.**, **Fix.** and **Source.**."""

    code: ClassVar[str]
    """Two letters of the area and three digits."""
    name: ClassVar[str]
    """Names the flaw; the file has the same name with underscores."""
    severity: ClassVar[Severity] = Severity.ERROR
    since: ClassVar[str] = "0.1"
    """The version of ros2-scaffold that had it first."""
    examples: ClassVar[tuple[Example, ...]]

    def check(self, package: Package) -> Iterator[Diagnostic]:
        """Yield what is wrong; a view that the package does not have ends the check silently."""
        raise NotImplementedError

    def report(self, at: Located, message: str, fix: Fix | None = None) -> Diagnostic:
        """Return a diagnostic of this rule at the place of ``at``."""
        return Diagnostic(self.code, self.name, self.severity, at.location, message, fix)
