"""Adds to a generated package by rendering it again with the new part."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any, NamedTuple

from scaffold.errors import InputError
from scaffold.generate import parts
from scaffold.generate.add.rendered_part import EXTRAS, Piece, Target
from scaffold.generate.draft import Draft, draft
from scaffold.generate.edit.edit import EDITED
from scaffold.generate.questions.defaults import DISTRO
from scaffold.generate.questions.questions import Given
from scaffold.generate.templates.template import BASE, Role
from scaffold.generate.update import branches, provenance, update
from scaffold.generate.update.merge import merge
from scaffold.generate.update.provenance import ATTRIBUTES, NAME, Provenance
from scaffold.model.package import Package
from scaffold.writing.transaction import BASES

OF_PACKAGES = (
    "license", "copyright_holder", "maintainer_name", "maintainer_email", "comments", DISTRO,
)  # fmt: skip
"""Questions of the package that parts ask as well; most are answered by the record."""


def provenance_of(target: Target) -> Provenance | None:
    """Return the record of how a package was generated, if it was.

    After a merge of branches it has the files of both.

    Raises:
        InputError: the record is damaged, or names a template that is not known here.
    """
    old = _read(target.package)
    if old is not None and old.merged:
        old = _joined(target, old)
    return old and old.with_roots(target.roots)


def _read(package: Package) -> Provenance | None:
    if not package.has(NAME):
        return None
    sidecar = package.source(BASES).text if package.has(BASES) else None
    path = f"{package.directory}/{NAME}"
    old = provenance.parse(package.source(NAME).text, path, sidecar)
    existing = {path: package.tree.read(path) for path in old.lost if package.has(path)}
    return old.completed(existing)


def remembered(old: Provenance | None) -> dict[str, Given]:
    """Return the recorded answers of a package that parts ask for."""
    answers = old.answers if old is not None else {}
    return {name: Given(answers[name], NAME) for name in OF_PACKAGES if name in answers}


def _joined(target: Target, old: Provenance) -> Provenance:
    given = update.recorded(old, target.templates, target.package.directory, [])

    def drafted(those: branches.Parts) -> Mapping[str, str]:
        changed = {**given, parts.ADD: Given(those, NAME)}
        return _draft_of(target, changed, old).rendered.files

    return branches.joined(old, drafted)


class Rerendered(NamedTuple):
    """The files of a generated package, rendered again with a piece."""

    files: dict[str, bytes]
    """The files to write, and the record."""
    edited: set[str]
    """The files that the user has edited, which need the edits of the piece."""


def with_piece(target: Target, old: Provenance, piece: Piece) -> Rerendered | None:
    """Render a package again with a piece; ``None`` if it has the piece already.

    The record becomes that of a package made with the piece. A later update then has nothing to
    add, except in files where the new lines conflict with those of the user.

    Args:
        target: The package as it is.
        old: How it was made.
        piece: What is added.

    Raises:
        InputError: the part does not fit the package, or what the templates gave for a file is
            lost.
    """
    answers = _with_piece(old, piece)
    if answers == old.answers:
        return None
    given = update.recorded(old, target.templates, target.package.directory, [])
    before = _draft_of(target, given, old).rendered.files
    new = {name: value for name, value in answers.items() if old.answers.get(name) != value}
    given |= {name: Given(value, NAME) for name, value in new.items()}
    following = [] if _is_edited(target.package, old) else _following(target, given, old)
    for name in following:
        del given[name]
    after = _draft_of(target, given, old)
    answers |= {name: after.answers[name] for name in following}
    old = old.completed({path: text.encode() for path, text in before.items()})
    update.refuse_lost(old, target.package.directory, old.lost)
    result = Rerendered({}, set())
    bases = dict(old.rendered)
    for path, text in after.rendered.files.items():
        if text != before.get(path):
            change = _Change(path, before.get(path, "").encode(), text.encode())
            bases |= _rerender(target.package, bases.get(path), change, piece, result)
    record = _recorded(target.package, old, old.with_files(answers, bases))
    result.files.update({path: text.encode() for path, text in record.items()})
    return result


def _rerender(
    package: Package, base: str | None, change: _Change, piece: Piece, result: Rerendered
) -> Mapping[str, str]:
    """Apply a change to a file of a package, and return it applied to its recorded text."""
    path = change.path
    exists = package.has(path)
    if base is None:
        if not exists and not _is_elsewhere(path, piece):
            result.files[path] = change.after
        return {path: change.after.decode()}
    merged = change.applied(base.encode())
    yours = package.tree.read(path) if exists else b""
    applied = merged if yours == base.encode() else change.applied(yours)
    if exists and path in EDITED and yours != base.encode():
        result.edited.add(path)
    elif exists and applied is not None:
        result.files[path] = applied
    elif exists and path != piece.addition.launch:
        return {}
    return {path: merged.decode()} if merged is not None else {}


class _Change(NamedTuple):
    """What a piece changes in a rendered file."""

    path: str
    before: bytes
    after: bytes

    def applied(self, content: bytes) -> bytes | None:
        """Return another version of the file with the change; ``None`` if they conflict."""
        if content == self.before:
            return self.after
        try:
            merged = merge(content, self.before, self.after)
        except InputError:  # there is no git
            return None
        return None if merged.conflicts else merged.content


def _is_edited(package: Package, old: Provenance) -> bool:
    """Return whether the user has edited a file that repeats answers, such as the description."""
    bases = {path: old.rendered[path].encode() for path in EDITED & old.rendered.keys()}
    return any(package.has(path) and package.tree.read(path) != bases[path] for path in bases)


def _is_elsewhere(path: str, piece: Piece) -> bool:
    """Return whether a package has a directory of its own for such a file of a piece."""
    names = {own.rpartition("/")[2] for own in piece.rendered.files}
    return path not in piece.rendered.files and path.rpartition("/")[2] in names


def is_noted(old: Provenance, piece: Piece) -> bool:
    """Return whether the record of a package has a piece."""
    return _with_piece(old, piece) == old.answers


def _recorded(package: Package, old: Provenance, new: Provenance) -> dict[str, str]:
    """Return the record with its sidecar, and at first with the git attributes for merging."""
    return new.files(is_new=not old.has_sidecar and not package.has(ATTRIBUTES))


def _with_piece(old: Provenance, piece: Piece) -> dict[str, Any]:
    """Return the recorded answers and those for a piece, unless it is there already."""
    if piece.template.role is Role.EXTRA:
        written = old.answers.get(EXTRAS, [])
        extras = written if isinstance(written, list) else [written]
        if piece.template.name in extras:
            return dict(old.answers)
        asked = {question.name for question in piece.template.questions}
        own = {name: value for name, value in piece.composed.answers.items() if name in asked}
        return {**old.answers, **own, EXTRAS: [*extras, piece.template.name]}
    part = piece.composed.answers[parts.ADD][0]
    name = piece.template.name_question
    existing = old.answers.get(parts.ADD, [])
    if any(
        (item[parts.KIND], item.get(name)) == (part[parts.KIND], part[name]) for item in existing
    ):
        return dict(old.answers)
    return {**old.answers, parts.ADD: [*existing, part]}


def _draft_of(target: Target, given: Mapping[str, Given], old: Provenance) -> Draft:
    return draft(target.roots, target.templates, given, target.user, old.date, target.place)


def _following(target: Target, given: Mapping[str, Given], old: Provenance) -> list[str]:
    """Return the questions with default answers that name the parts, and so change with them."""
    questions = [
        item
        for item in target.templates[BASE].questions
        if item.name in given and re.search(r"\bcontents\b", str(item.default))
    ]
    names = {question.name for question in questions}
    if not names:
        return []
    asked = {name: item for name, item in given.items() if name not in names}
    asked[parts.ADD] = Given(old.answers.get(parts.ADD, []), NAME)
    answers = _draft_of(target, asked, old).answers
    return [name for name in names if answers[name] == old.answers[name]]
