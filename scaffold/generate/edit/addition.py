"""The addition to a package, and the result of each edit."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from scaffold.check.fixes.fixer import splice
from scaffold.edits import Edit
from scaffold.record import NamedTuple
from scaffold.source import Source

NOTHING: Mapping[str, Sequence[str]] = {}


class Program(NamedTuple):
    """A Python file that becomes an executable."""

    path: str
    """Relative to the root of the package."""
    name: str
    """What ``ros2 run`` calls it."""
    module: str
    """Its dotted name, for the entry point of an ament_python package."""
    is_node: bool = True
    """Whether a launch file may start it as a node."""

    @property
    def entry_point(self) -> str:
        """The function that setuptools calls."""
        return f"{self.module}:main"


class Compiled(NamedTuple):
    """A C++ program."""

    name: str
    """The target, and what ``ros2 run`` calls it."""
    source: str
    """The path of its source."""


class Addition(NamedTuple):
    """What is added to a package besides new files."""

    package: str
    """The name of the package."""
    program: Program | None = None
    compiled: Compiled | None = None
    test: str | None = None
    """The path of a pytest file."""
    depends: Mapping[str, Sequence[str]] = NOTHING
    """Names by kind: ``buildtool``, ``build``, ``build_export``, ``exec``, ``depend``, ``test``."""
    groups: Sequence[str] = ()
    """Groups that the package becomes a member of."""
    interfaces: Sequence[str] = ()
    """Paths of .msg, .srv and .action files to generate code from."""
    interface_depends: Sequence[str] = ()
    """Packages whose types the interfaces use."""
    directories: Sequence[str] = ()
    """Directories to install to ``share/<package>``, with their names."""
    shared: Sequence[str] = ()
    """The new files in these directories."""
    readme: str = ""
    """README.md of a package with only the new parts, whose sections are merged."""
    changes: Sequence[str] = ()
    """Lines for the next release in CHANGELOG.rst."""
    launch: str = ""
    """The launch file that starts it, if the user has named one."""


def inside(addition: Addition, directory: str) -> list[str]:
    """Return the new files directly in a directory."""
    return [path for path in addition.shared if path.rpartition("/")[0] == directory]


class ByHand(NamedTuple):
    """A line that the user has to add, because no edit was safe."""

    path: str
    line: str
    reason: str
    is_needed: bool = True
    """Whether the addition is not built, found or tested without it."""


class Outcome(NamedTuple):
    """The result of the edits of a file."""

    source: Source
    by_hand: tuple[ByHand, ...] = ()


def spliced(source: Source, edits: Sequence[Edit]) -> Source:
    """Return the file with non-overlapping edits applied."""
    return Source(source.path, splice(source.text, edits), source.encoding)
