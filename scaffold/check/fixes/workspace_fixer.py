"""Fixes all packages of a workspace in memory, until no more fixes apply.

Most fixes are of style, and each edit of a file would run the rules on it again, so style is fixed
first. A fix in one package may change the findings of another: all packages are checked, then all
are fixed, and those that changed or that read a changed one are checked again.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Protocol

from scaffold.check.cache.results import Needs
from scaffold.check.fixes import fixer
from scaffold.check.fixes.fixer import MAX_ROUNDS, Fixed
from scaffold.check.fixes.overlay import Overlay
from scaffold.check.result import Earlier, Verdict
from scaffold.model.reads import is_followed

if TYPE_CHECKING:
    from scaffold.check.result import Result
    from scaffold.check.session import Session
    from scaffold.diagnostic import Diagnostic
    from scaffold.model.discovery.targets import Target


class Progress(Protocol):
    """Shows the progress of the work."""

    def begin(self, label: str, total: int) -> None:
        """Start another part of the work."""

    def step(self) -> None:
        """Count one of the total as done."""


class _Piece:
    """A package that is being fixed."""

    def __init__(self, target: Target) -> None:
        self.target = target
        self.package = target.package
        self.overlay = Overlay(target.package.tree)
        self.result: Result | None = None
        """Of the last check."""
        self.checked = self.overlay
        """The files at that time."""
        self.identity = target.package.identity
        self.earlier: Earlier | None = None
        """The reusable results of the last check, for the next one."""
        self.style: dict[str, Sequence[Diagnostic]] = {}
        """The style findings in files edited since then."""
        self.applied = 0

    @property
    def diagnostics(self) -> list[Diagnostic]:
        """What the last check found."""
        return self.result.diagnostics if self.result is not None else []

    def take(self, result: Result) -> None:
        """Keep what a check found."""
        self.result, self.checked, self.earlier = result, self.overlay, None
        self.identity = self.package.identity
        self.style.clear()

    def apply(self, diagnostics: list[Diagnostic], *, unsafe: bool) -> bool:
        """Apply fixes; tell whether there were any."""
        self.overlay, applied = fixer.apply(self.package, self.overlay, diagnostics, unsafe=unsafe)
        self.applied += applied
        if applied:
            self.package.change(self.overlay)
        return applied > 0

    def edited(self) -> frozenset[str] | None:
        """Return the tracked files that differ from the last check, ``None`` if others do."""
        edited = self.overlay.edited_since(self.checked)
        if edited is None or not all(map(is_followed, edited)):
            return None
        if self.package.identity != self.identity:
            return None
        return frozenset(map(self.package.full_path, edited))

    def leave(self, edited: frozenset[str] | None) -> None:
        """Keep the results of the last check that do not depend on edited files."""
        verdict = self.result.verdict if self.result is not None else None
        if edited is not None and verdict is not None and edited.isdisjoint(verdict.configuring):
            left = Earlier.of(self.package, verdict, edited)
            style = {**left.verdict.style, **self.style}
            self.earlier = left._replace(verdict=left.verdict._replace(style=style))

    def leave_style(self) -> None:
        """Keep only the style findings for the next check."""
        files = frozenset(map(self.package.full_path, self.package.files))
        self.earlier = Earlier(Verdict({}, dict(self.style), [], {}), files, {})


def fix(
    targets: Sequence[Target], session: Session, progress: Progress, *, unsafe: bool = False
) -> list[Fixed]:
    """Fix packages that see each other; nothing is written.

    Args:
        targets: Packages, or files of them: then findings there are fixed, wherever the fix
            is. Their files are in memory afterwards.
        session: Checks them.
        progress: Receives the progress.
        unsafe: Whether to apply unsafe fixes as well.
    """
    pieces = [_Piece(target) for target in targets]
    progress.begin("style", len(pieces))
    styles = session.check_styles([piece.package for piece in pieces])
    for piece, style in zip(pieces, styles, strict=True):
        if _fix_style(piece, session, style, unsafe=unsafe):
            piece.leave_style()
        progress.step()
    pending = pieces
    for number in range(1, MAX_ROUNDS + 1):
        _check(pending, session, progress, f"round {number}")
        changed = [item for item in pending if item.apply(item.diagnostics, unsafe=unsafe)]
        for piece in changed:
            _fix_style(piece, session, unsafe=unsafe)
        pending = _affected(pieces, changed)
        if not pending:
            break
    if pending:
        _check(pending, session, progress, "last look")
    return [
        fixer.outcome(
            piece.package,
            piece.overlay,
            piece.diagnostics,
            piece.applied,
            unsafe=unsafe,
            is_settled=piece not in pending,
        )
        for piece in pieces
    ]


def _fix_style(
    piece: _Piece,
    session: Session,
    style: Mapping[str, Sequence[Diagnostic]] | None = None,
    *,
    unsafe: bool,
) -> bool:
    """Fix the style of edited files until it is stable; return whether it is.

    Args:
        piece: The package.
        session: Checks it.
        style: The initial style findings of any files, if known.
        unsafe: Whether to apply unsafe fixes as well.
    """
    before = piece.checked
    for _ in range(MAX_ROUNDS):
        if style is None:
            paths = piece.overlay.edited_since(before) or piece.package.files
            style = session.check_style(piece.package, paths)
        piece.style.update(style)
        selected = session.selected(
            piece.target, (item for diagnostics in style.values() for item in diagnostics)
        )
        before, style = piece.overlay, None
        if not piece.apply(selected, unsafe=unsafe):
            return True
    piece.style.clear()
    return False


def _affected(pieces: Sequence[_Piece], changed: Sequence[_Piece]) -> list[_Piece]:
    """Return the changed packages and those whose findings may depend on them."""
    if not changed:
        return []
    packages = [piece.package for piece in pieces]
    needs = Needs(packages, [package.identity for package in packages])
    edits = {at: item.edited() for at, item in enumerate(pieces) if item in changed}
    affected: list[_Piece] = []
    for at, piece in enumerate(pieces):
        needed = needs.of(piece.package)
        places = edits.keys() & (edits.keys() if needed is None else {at, *needed})
        if places:
            affected.append(piece)
            files = [edits[place] for place in places]
            is_known = None not in files
            piece.leave(frozenset().union(*(some or () for some in files)) if is_known else None)
    for workspace in {id(item.known_workspace): item.known_workspace for item in packages}.values():
        if workspace is not None:
            workspace.forget()
    return affected


def _check(pieces: Sequence[_Piece], session: Session, progress: Progress, label: str) -> None:
    progress.begin(label, len(pieces))
    earlier = {item.package.directory: item.earlier for item in pieces if item.earlier is not None}
    results = session.run([item.target for item in pieces], earlier)
    for piece, result in zip(pieces, results, strict=True):
        piece.take(result)
        progress.step()
