"""Applies fixes in memory: whole fixes, none that overlap, checked again until quiet."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from contextlib import suppress

from scaffold.check.diagnostic import (
    CreateFile,
    Diagnostic,
    Edit,
    Fix,
    MakeExecutable,
    Remove,
    Safety,
)
from scaffold.model.disk import MOST_BYTES
from scaffold.model.package import Package
from scaffold.model.tree import Tree, within
from scaffold.record import NamedTuple

MAX_ROUNDS = 10
"""Fixes that still find work after this many rounds work against each other."""


class Fixed(NamedTuple):
    """The outcome of fixing one package."""

    package: Package
    """The package after the fixes, in memory."""
    changed: Mapping[str, bytes]
    """New content by path, for files that differ or are new."""
    removed: frozenset[str]
    executable: frozenset[str]
    """Files that get their executable bits."""
    applied: int
    """How many fixes were applied."""


class Overlay:
    """A tree with changes on top of it, none of them on disk."""

    def __init__(self, base: Tree) -> None:
        self._base = base
        self.place: str | None = getattr(base, "root", None)
        """The directory of what is below the changes, if it is on disk."""
        self.changed: dict[str, bytes] = {}
        self.removed: set[str] = set()
        self.executable: set[str] = set()

    @property
    def files(self) -> tuple[str, ...]:
        """The paths of all files."""
        return tuple(sorted({*self._base.files, *self.changed} - self.removed))

    @property
    def directories(self) -> frozenset[str]:
        """The paths of all directories."""
        parents = {path[:at] for path in self.changed for at in _slashes(path)}
        return frozenset({*self._base.directories, *parents})

    @property
    def nested(self) -> tuple[str, ...]:
        """The directories that hold a package of their own."""
        return tuple(self._base.nested)

    def read(self, path: str, most: int = MOST_BYTES) -> bytes:
        """Return what is in a file of so many bytes at most; raises OSError."""
        if path in self.removed:
            raise FileNotFoundError(path)
        if path in self.changed:
            return within(most, path, self.changed[path])
        return self._base.read(path, most)

    def is_executable(self, path: str) -> bool:
        """Tell whether the file has, or gets, an executable bit."""
        return path in self.executable or self._base.is_executable(path)

    def copy(self) -> Overlay:
        """Return an independent copy."""
        twin = Overlay(self._base)
        twin.changed, twin.removed = dict(self.changed), set(self.removed)
        twin.executable = set(self.executable)
        return twin


def fix(
    package: Package,
    check: Callable[[Package], list[Diagnostic]],
    *,
    unsafe: bool = False,
) -> Fixed:
    """Apply the fixes of what ``check`` finds, until it finds nothing more to fix.

    Args:
        package: The package as it is.
        check: Returns the diagnostics of a package.
        unsafe: Apply the fixes that the author should look at, too.
    """
    overlay = Overlay(package.tree)
    count = 0
    for _ in range(MAX_ROUNDS):
        overlay, applied = _apply_round(package, overlay, check, unsafe=unsafe)
        count += applied
        if not applied:
            break
    after = _on(package, overlay)
    same = {path for path, data in overlay.changed.items() if _had(package, path) == data}
    changed = {path: data for path, data in overlay.changed.items() if path not in same}
    return Fixed(after, changed, frozenset(overlay.removed), frozenset(overlay.executable), count)


def _apply_round(
    package: Package,
    overlay: Overlay,
    check: Callable[[Package], list[Diagnostic]],
    *,
    unsafe: bool,
) -> tuple[Overlay, int]:
    current = _on(package, overlay)
    fixes = [
        diagnostic.fix
        for diagnostic in check(current)
        if diagnostic.fix and (unsafe or diagnostic.fix.safety is Safety.SAFE)
    ]
    chosen = _compatible(fixes)
    result = overlay.copy()
    edits: dict[str, list[Edit]] = {}
    for change in dict.fromkeys(change for one in chosen for change in one.changes):
        if isinstance(change, Edit):
            edits.setdefault(change.path, []).append(change)
        elif isinstance(change, CreateFile):
            result.changed[change.path] = change.text.encode()
            result.removed.discard(change.path)
        elif isinstance(change, MakeExecutable):
            result.executable.add(change.path)
        else:
            result.changed.pop(change.path, None)
            result.removed.add(change.path)
    for path, ones in edits.items():
        source = current.editable(path)
        text = splice(source.text, ones)
        if path.endswith(".py") and _is_python(source.text) and not _is_python(text):
            continue  # the fixes work against each other: better none than a broken file
        with suppress(UnicodeError):  # what the file's encoding cannot hold is not written
            result.changed[path] = text.encode(source.encoding)
    return result, len(chosen)


def _is_python(text: str) -> bool:
    import ast
    import warnings

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            ast.parse(text.removeprefix("\ufeff"))
        except (SyntaxError, ValueError, RecursionError, MemoryError):
            return False
    return True


def splice(text: str, edits: Iterable[Edit]) -> str:
    """Return the text with edits that do not overlap."""
    parts: list[str] = []
    at = 0
    for edit in sorted(edits, key=lambda edit: (edit.start, edit.end)):
        parts += text[at : edit.start], edit.text
        at = edit.end
    return "".join([*parts, text[at:]])


def _compatible(fixes: Iterable[Fix]) -> list[Fix]:
    """Return fixes in order, without those that touch what an earlier one touches."""
    chosen: list[Fix] = []
    taken: dict[str, list[tuple[int, int]]] = {}
    whole: set[str] = set()
    for one in dict.fromkeys(fixes):
        spans = [(c.path, c.start, c.end) for c in one.changes if isinstance(c, Edit)]
        files = {c.path for c in one.changes if isinstance(c, CreateFile | Remove)}
        clash = any(
            path in whole or any(start <= b and a <= end for a, b in taken.get(path, ()))
            for path, start, end in spans
        )
        if clash or files & (whole | taken.keys()):
            continue
        for path, start, end in spans:
            taken.setdefault(path, []).append((start, end))
        whole |= files
        chosen.append(one)
    return chosen


def _on(package: Package, overlay: Overlay) -> Package:
    return Package(overlay, directory=package.directory, workspace=package.known_workspace)


def _had(package: Package, path: str) -> bytes | None:
    try:
        return package.tree.read(path)
    except OSError:
        return None


def _slashes(path: str) -> list[int]:
    return [at for at, character in enumerate(path) if character == "/"]
