"""Applies non-overlapping fixes to a package in memory, in rounds."""

from __future__ import annotations

from bisect import bisect_left, bisect_right, insort
from collections.abc import Callable, Iterable, Mapping, Sequence

from scaffold.check.fixes.overlay import Overlay
from scaffold.check.fixes.soundness import breaks
from scaffold.diagnostic import Diagnostic
from scaffold.edits import Change, CreateFile, Edit, Fix, MakeExecutable, Remove, Safety
from scaffold.files.tree import MANIFEST
from scaffold.model.package import Package
from scaffold.record import NamedTuple
from scaffold.source import ViewError

MAX_ROUNDS = 10
"""The maximum number of rounds; fixes that need more conflict with each other."""
MAX_ROUNDS_OF_FILE = 6
"""The maximum number of rounds per file; in 22 public repositories three are enough."""

Check = Callable[[Package], list[Diagnostic]]


class Fixed(NamedTuple):
    """The outcome of fixing one package."""

    package: Package
    """The package after the fixes, in memory."""
    before: Mapping[str, bytes]
    """The previous content of changed and removed files."""
    changed: Mapping[str, bytes]
    """New content by path, for files that differ or are new."""
    removed: frozenset[str]
    executable: frozenset[str]
    """Files to make executable."""
    applied: int
    """How many fixes were applied."""
    diagnostics: list[Diagnostic]
    """The remaining findings, without fixes that would break their file."""
    unsettled: frozenset[str]
    """Codes that still had fixes after the maximum number of rounds."""

    @property
    def is_change(self) -> bool:
        """Whether anything differs from what is on disk."""
        return bool(self.changed or self.removed or self.executable)

    def then(self, later: Fixed) -> Fixed:
        """Combine it with the outcome of later fixes."""
        removed = (self.removed - later.changed.keys()) | later.removed
        changed = {**self.changed, **later.changed}
        return later._replace(
            before={**later.before, **self.before},
            changed={path: data for path, data in changed.items() if path not in removed},
            removed=removed,
            executable=self.executable | later.executable,
            applied=self.applied,
        )


class Step(NamedTuple):
    """The outcome of one round."""

    overlay: Overlay
    applied: int


def fix(package: Package, check: Check, *, unsafe: bool = False) -> Fixed:
    """Apply the fixes of the findings of ``check``, until there are no more.

    Args:
        package: The package as it is.
        check: Returns the diagnostics of a package.
        unsafe: Whether to apply unsafe fixes as well.
    """
    overlay = Overlay(package.tree)
    count = 0
    for _ in range(MAX_ROUNDS):
        current = on(package, overlay)
        diagnostics = check(current)
        overlay, applied = apply(current, overlay, diagnostics, unsafe=unsafe)
        count += applied
        if not applied:
            return outcome(current, overlay, diagnostics, count, unsafe=unsafe, is_settled=True)
    current = on(package, overlay)
    return outcome(current, overlay, check(current), count, unsafe=unsafe, is_settled=False)


def on(package: Package, overlay: Overlay) -> Package:
    """Return a package with other files."""
    return Package(overlay, directory=package.directory, workspace=package.known_workspace)


def outcome(
    package: Package,
    overlay: Overlay,
    diagnostics: list[Diagnostic],
    applied: int,
    *,
    unsafe: bool,
    is_settled: bool,
) -> Fixed:
    """Return the outcome of fixing a package.

    Args:
        package: The package after the fixes.
        overlay: Its files.
        diagnostics: The remaining findings.
        applied: How many fixes were applied.
        unsafe: Whether unsafe fixes were applied.
        is_settled: Whether the last round had no more fixes to apply.
    """
    pending = [
        diagnostic for diagnostic in diagnostics if _is_wanted(diagnostic.fix, unsafe=unsafe)
    ]
    late = [item for item in pending if not is_settled or _is_too_late(item.fix, overlay)]
    unsettled = frozenset(item.code for item in late)
    refused = {id(item) for item in pending} - {id(item) for item in late}
    if refused:
        diagnostics = [
            diagnostic._replace(fix=None) if id(diagnostic) in refused else diagnostic
            for diagnostic in diagnostics
        ]
    changed = overlay.differing
    before = {path: data for path in {*changed, *overlay.removed} for data in overlay.had(path)}
    removed, executable = frozenset(overlay.removed), frozenset(overlay.executable)
    return Fixed(package, before, changed, removed, executable, applied, diagnostics, unsettled)


def apply(
    package: Package, overlay: Overlay, diagnostics: Iterable[Diagnostic], *, unsafe: bool
) -> Step:
    """Apply the fixes of some diagnostics, as many as do not overlap.

    Args:
        package: The package of the diagnostics.
        overlay: Its files, which are not changed.
        diagnostics: The diagnostics.
        unsafe: Whether to apply unsafe fixes as well.

    Returns:
        The files after the fixes, and the number of applied fixes.
    """
    fixes = _independent([item for item in diagnostics if _is_wanted(item.fix, unsafe=unsafe)])
    inside = [fixed for item in fixes if (fixed := _within_package(item, overlay)) is not None]
    timely = [item for item in inside if not _is_too_late(item, overlay)]
    chosen, texts = _safe_fixes(package, _compatible(package, timely))
    result = overlay.copy()
    result.rounds.update({change.path for item in chosen for change in item.changes})
    for change in _changes(chosen):
        if isinstance(change, CreateFile):
            result.changed[change.path] = change.text.encode()
            result.removed.discard(change.path)
        elif isinstance(change, MakeExecutable):
            result.executable.add(change.path)
        elif isinstance(change, Remove):
            result.changed.pop(change.path, None)
            result.removed.add(change.path)
    result.changed.update(texts)
    return Step(result, len(chosen))


def _is_too_late(fix: Fix | None, overlay: Overlay) -> bool:
    """Return whether a file of a fix has been edited in too many rounds."""
    return fix is not None and any(
        overlay.rounds[change.path] >= MAX_ROUNDS_OF_FILE for change in fix.changes
    )


def _is_wanted(fix: Fix | None, *, unsafe: bool) -> bool:
    return fix is not None and (unsafe or fix.safety is Safety.SAFE)


def _independent(diagnostics: Sequence[Diagnostic]) -> list[Fix]:
    """Return the fixes that need not wait for others.

    A fix that edits another file than that of its diagnostic waits while its line is edited: an
    unused import is removed before a dependency is declared for it.
    """
    lines = {
        (item.location.path, item.location.line) for item in diagnostics if _edits_own_file(item)
    }
    return [
        item.fix
        for item in diagnostics
        if item.fix is not None
        and (_edits_own_file(item) or (item.location.path, item.location.line) not in lines)
    ]


def _edits_own_file(diagnostic: Diagnostic) -> bool:
    return diagnostic.fix is not None and any(
        change.path == diagnostic.location.path for change in diagnostic.fix.changes
    )


def _changes(fixes: Iterable[Fix]) -> list[Change]:
    """Return the changes of fixes, each once."""
    return [*dict.fromkeys(change for item in fixes for change in item.changes)]


def _within_package(fix: Fix, overlay: Overlay) -> Fix | None:
    """Return a fix with real paths; ``None`` if a symlink leads out of the package."""
    changes: list[Change] = []
    for change in fix.changes:
        path = overlay.real(change.path)
        if path is None:
            return None
        changes.append(change if path == change.path else change._replace(path=path))
    return fix._replace(changes=tuple(changes))


# -- compatible fixes


def _compatible(package: Package, fixes: Iterable[Fix]) -> list[Fix]:
    """Return fixes in order, without those that overlap an earlier one."""
    chosen: list[Fix] = []
    taken: dict[str, list[Edit]] = {}
    whole: set[str] = set()
    for item in dict.fromkeys(fixes):
        edits = [change for change in item.changes if isinstance(change, Edit)]
        files = {c.path for c in item.changes if isinstance(c, CreateFile | Remove)}
        clash = any(
            edit.path in whole
            or any(
                not _go_together(package, edit, other)
                for other in _adjacent(edit, taken.get(edit.path, ()))
            )
            for edit in edits
        )
        if clash or files & (whole | taken.keys()):
            continue
        for edit in edits:
            insort(taken.setdefault(edit.path, []), edit, key=_start)
        whole |= files
        chosen.append(item)
    return chosen


def _adjacent(edit: Edit, others: Sequence[Edit]) -> Sequence[Edit]:
    """Return those of some sorted, disjoint edits that touch another one."""
    first = bisect_left(others, edit.start, key=_end)
    return others[first : bisect_right(others, edit.end, key=_start)]


def _start(edit: Edit) -> int:
    return edit.start


def _end(edit: Edit) -> int:
    return edit.end


def _go_together(package: Package, edit: Edit, other: Edit) -> bool:
    """Return whether two edits that touch each other are compatible."""
    return _are_neighbors(package, edit, other) or _are_dependencies(edit, other)


def _are_neighbors(package: Package, edit: Edit, other: Edit) -> bool:
    """Return whether both remove adjacent whole lines."""
    first, second = sorted((edit, other), key=_start)
    if edit.text or other.text or not first.start < first.end == second.start < second.end:
        return False
    try:
        text = package.editable(edit.path).text
    except ViewError:
        return False
    places = (first.start, second.start, second.end)
    return all(at in {0, len(text)} or text[at - 1] == "\n" for at in places)


def _are_dependencies(edit: Edit, other: Edit) -> bool:
    """Return whether both insert a dependency on a separate line at one place."""
    if edit.path != MANIFEST or not edit.start == edit.end == other.start == other.end:
        return False
    from scaffold.model.manifest.edit import inserted_dependency

    first, second = inserted_dependency(edit), inserted_dependency(other)
    return bool(first and second and first.is_before == second.is_before) and (
        edit.text == other.text or first.name != second.name  # type: ignore[union-attr]  # see above
    )


def splice(text: str, edits: Iterable[Edit]) -> str:
    """Return the text with edits that do not overlap."""
    parts: list[str] = []
    at = 0
    for edit in sorted(edits, key=_sort_key):
        parts += text[at : edit.start], edit.text
        at = edit.end
    return "".join([*parts, text[at:]])


def _sort_key(edit: Edit) -> tuple[int, int, tuple[int, str]]:
    """Return the sort key of edits; at the same place, dependencies are sorted by custom."""
    if edit.path != MANIFEST or edit.start != edit.end:
        return edit.start, edit.end, (0, "")
    from scaffold.model.manifest.edit import inserted_dependency

    inserted = inserted_dependency(edit)
    return edit.start, edit.end, (inserted.rank, inserted.name) if inserted else (0, "")


# -- soundness


def _safe_fixes(package: Package, fixes: list[Fix]) -> tuple[list[Fix], Mapping[str, bytes]]:
    """Return the fixes that break no file, and the new content of the files they edit."""
    while True:
        edits: dict[str, list[Edit]] = {}
        for change in _changes(fixes):
            if isinstance(change, Edit):
                edits.setdefault(change.path, []).append(change)
        texts = {path: _edited(package, path, ones) for path, ones in edits.items()}
        broken = next((path for path, data in texts.items() if data is None), None)
        if broken is None:
            return fixes, {path: data for path, data in texts.items() if data is not None}
        touching = [item for item in fixes if _edits_of(item, broken)]
        kept = {id(item) for item in _largest(package, broken, touching)}
        fixes = [item for item in fixes if not _edits_of(item, broken) or id(item) in kept]


def _largest(package: Package, path: str, fixes: Sequence[Fix]) -> Sequence[Fix]:
    """Return a large subset of fixes that together do not break a file."""
    edits = [edit for item in fixes for edit in _edits_of(item, path)]
    if not fixes or _edited(package, path, dict.fromkeys(edits)) is not None:
        return fixes
    if len(fixes) == 1:
        return ()
    middle = len(fixes) // 2
    first = _largest(package, path, fixes[:middle])
    second = _largest(package, path, fixes[middle:])
    both = [*first, *second]
    edits = [edit for item in both for edit in _edits_of(item, path)]
    is_sound = _edited(package, path, dict.fromkeys(edits)) is not None
    return both if is_sound else first or second


def _edits_of(fix: Fix, path: str) -> list[Edit]:
    return [change for change in fix.changes if isinstance(change, Edit) and change.path == path]


def _edited(package: Package, path: str, edits: Iterable[Edit]) -> bytes | None:
    """Return the new content of a file; ``None`` if it would be broken."""
    try:
        source = package.editable(path)
        before = source.text.encode(source.encoding)
        text = splice(source.text, edits)
        after = text.encode(source.encoding)
    except (ViewError, UnicodeError, LookupError):
        return None
    if before != package.tree.read(path) or breaks(path, source.text, text):
        return None
    return after
