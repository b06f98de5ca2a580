"""Records the files from which a view of a package, or a finding, was derived.

Changes of content in files of the usual formats invalidate only what depends on those files; any
other change in a package invalidates everything in it.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from scaffold.files.tree import CMAKE_LISTS, SETUP_CFG

if TYPE_CHECKING:
    from scaffold.model.facts import Fact


class Reads:
    """The files that something was made of, directly or through views.

    A view may read more files when it is used; that counts for everything made of it, also if
    that was before.
    """

    __slots__ = ("facts", "files", "views")

    def __init__(self) -> None:
        self.files: set[str] = set()
        """The files whose content was accessed."""
        self.facts: set[Fact] = set()
        """What was asked of files without looking at them."""
        self.views: set[Reads] = set()

    def all(self) -> tuple[frozenset[str], frozenset[Fact]]:
        """Return files and facts, those of the views included."""
        seen = {self}
        pending = [self]
        while pending:
            for view in pending.pop().views:
                if view not in seen:
                    seen.add(view)
                    pending.append(view)
        files = frozenset[str]().union(*(reads.files for reads in seen))
        facts = {fact.id: fact for reads in seen for fact in reads.facts}
        return files, frozenset(facts.values())


_FOLLOWED = (".py", ".xml", ".yaml", ".yml", ".urdf", ".xacro", CMAKE_LISTS, SETUP_CFG)
"""What the paths of files end with that are read through views of the package alone."""
_recorders: list[Reads] = []


class recorded:  # noqa: N801  used like a function; a generator would take twice the time
    """Note in ``reads``, and only there, what the block looks at."""

    __slots__ = ("_reads",)

    def __init__(self, reads: Reads) -> None:
        self._reads = reads

    def __enter__(self) -> None:
        _recorders.append(self._reads)

    def __exit__(self, *_: object) -> None:
        _recorders.pop()


def current() -> Reads:
    """Return the current record of accesses."""
    return _recorders[-1] if _recorders else Reads()


def note_file(path: str) -> None:
    """Note that the content of a file was accessed."""
    if _recorders:
        _recorders[-1].files.add(path)


def note_fact(fact: Fact) -> None:
    """Note that a fact was used."""
    if _recorders:
        _recorders[-1].facts.add(fact)


def note_view(reads: Reads) -> None:
    """Note that something derived from ``reads`` was used."""
    if _recorders and _recorders[-1] is not reads:
        _recorders[-1].views.add(reads)


def is_followed(path: str) -> bool:
    """Tell whether changes of the content of a file are followed."""
    return path.endswith(_FOLLOWED)
