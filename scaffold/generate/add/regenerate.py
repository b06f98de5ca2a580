"""Adds to a generated package by rendering it again with the new part."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any

from scaffold.generate import parts
from scaffold.generate.add.rendered_part import EXTRAS, Piece, Target
from scaffold.generate.draft import Draft, draft
from scaffold.generate.edit.edit import edit
from scaffold.generate.questions.defaults import DISTRO
from scaffold.generate.questions.questions import Given
from scaffold.generate.repository import inside
from scaffold.generate.templates.template import BASE, Role
from scaffold.generate.update import branches, provenance, update
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


def as_new(target: Target, old: Provenance, piece: Piece) -> dict[str, str] | None:
    """Return the files that would differ if the package had been made with a piece.

    ``None`` where one of them has been changed since, where the templates have, or where the piece
    is there already: then the files have to be edited.

    Args:
        target: The package as it is.
        old: How it was made.
        piece: What is added.

    Raises:
        InputError: the part does not fit the package.
    """
    answers = _with_piece(old, piece)
    if answers == old.answers:
        return None
    given = update.recorded(old, target.templates, target.package.directory, [])
    before = _draft_of(target, given, old)
    new = {name: value for name, value in answers.items() if old.answers.get(name) != value}
    given |= {name: Given(value, NAME) for name, value in new.items()}
    following = _following(target, given, old)
    for name in following:
        del given[name]
    after = _draft_of(target, given, old)
    answers |= {name: after.answers[name] for name in following}
    files, wanted = before.rendered.files, after.rendered.files
    old = old.completed({path: text.encode() for path, text in files.items()})
    changed = {path: text for path, text in wanted.items() if files.get(path) != text}
    in_step = files == old.rendered and not old.lost and files.keys() <= wanted.keys()
    package = target.package
    if not in_step or not all(_is_as(package, path, files.get(path)) for path in changed):
        return None
    return {**changed, **_recorded(package, old, old.with_files(answers, wanted))}


def is_noted(old: Provenance, piece: Piece) -> bool:
    """Return whether the record of a package has a piece."""
    return _with_piece(old, piece) == old.answers


def noted(package: Package, old: Provenance, piece: Piece) -> dict[str, bytes]:
    """Return the record of an edited package, with a piece added.

    Args:
        package: The package as it is.
        old: How the package was made.
        piece: What is added, as of the day that the package was made.

    Raises:
        InputError: what the templates gave for a file is lost.
    """
    answers = _with_piece(old, piece)
    if answers == old.answers:
        return {}
    update.refuse_lost(old, package.directory, old.lost)
    base = Package.of({**inside(old.rendered), NAME: ""})
    files = {**piece.rendered.files, **old.rendered}
    files |= {path: data.decode() for path, data in edit(base, piece.addition).files.items()}
    written = _recorded(package, old, old.with_files(answers, files))
    return {path: text.encode() for path, text in written.items()}


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


def _is_as(package: Package, path: str, text: str | None) -> bool:
    """Return whether a generated file is unedited; ``None`` if it was not generated."""
    if text is None or not package.has(path):
        return text is None and not package.has(path)
    return package.tree.read(path) == text.encode()
