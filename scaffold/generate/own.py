"""Adds a part to a package of ours: where nobody has changed it, it becomes what `new` makes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from scaffold.generate import parts, provenance, update
from scaffold.generate.defaults import User
from scaffold.generate.draft import Composed, draft
from scaffold.generate.edit.addition import Addition
from scaffold.generate.edit.edit import edit
from scaffold.generate.provenance import NAME, Provenance
from scaffold.generate.questions import Given
from scaffold.generate.render import Rendered
from scaffold.generate.template import PARTS, Template
from scaffold.model.package import Package

OF_PACKAGES = ("license", "copyright_holder", "maintainer_name", "maintainer_email", "comments")
"""The questions of the base that a part asks, too; a package has answered most of them."""


def provenance_of(package: Package) -> Provenance | None:
    """Return how a package was made, if it is one of ours.

    Raises:
        InputError: the record is damaged.
    """
    if not package.has(NAME):
        return None
    return provenance.parse(package.source(NAME).text, f"{package.directory}/{NAME}")


def remembered(old: Provenance | None) -> dict[str, Given]:
    """Return the answers that a package was made with, as far as parts ask for them."""
    answers = old.answers if old is not None else {}
    return {name: Given(answers[name], NAME) for name in OF_PACKAGES if name in answers}


def as_new(
    package: Package,
    old: Provenance,
    composed: Composed,
    roots: Sequence[str],
    templates: Mapping[str, Template],
    user: User,
) -> dict[str, str] | None:
    """Return the files that would differ if the package had been made with a part.

    ``None`` where one of them has been changed since, where the templates have, or where the part
    is there already: then the files have to be edited.

    Args:
        package: The package as it is.
        old: How it was made.
        composed: The part.
        roots: The ``templates`` directories; a later one wins.
        templates: The templates in them.
        user: Knows what new questions may want.

    Raises:
        InputError: the part does not fit the others.
    """
    answers = _with_part(old, composed)
    if answers == old.answers:
        return None
    given = update.recorded(old, templates, package.directory, [])
    before = draft(roots, templates, given, user, old.date).rendered.files
    given[parts.ADD] = Given(answers[parts.ADD], NAME)
    after = draft(roots, templates, given, user, old.date).rendered.files
    changed = {path: text for path, text in after.items() if before.get(path) != text}
    in_step = before == old.rendered and before.keys() <= after.keys()
    if not in_step or not all(_is_as(package, path, before.get(path)) for path in changed):
        return None
    return {**changed, NAME: old._replace(answers=answers, rendered=after).text()}


def noted(
    old: Provenance, composed: Composed, rendered: Rendered, addition: Addition
) -> dict[str, bytes]:
    """Return the record of a package whose files are edited, with the part in it.

    Args:
        old: How the package was made.
        composed: The part.
        rendered: Its files as of the day that the package was made.
        addition: What is edited.
    """
    answers = _with_part(old, composed)
    if answers == old.answers:
        return {}
    base = Package.of({**old.rendered, NAME: ""})
    files = {**rendered.files, **old.rendered}
    files |= {path: data.decode() for path, data in edit(base, addition).files.items()}
    return {NAME: old._replace(answers=answers, rendered=files).text().encode()}


def _with_part(old: Provenance, composed: Composed) -> dict[str, Any]:
    """Return the recorded answers and those for a part, unless it is there already."""
    part = composed.answers[parts.ADD][0]
    name = next(layer for layer in composed.layers if layer.role in PARTS).name_question
    known = old.answers.get(parts.ADD, [])
    if any((one[parts.KIND], one.get(name)) == (part[parts.KIND], part[name]) for one in known):
        return dict(old.answers)
    return {**old.answers, parts.ADD: [*known, part]}


def _is_as(package: Package, path: str, text: str | None) -> bool:
    """Tell whether a file is as it was made; ``None``: it was not."""
    if text is None or not package.has(path):
        return text is None and not package.has(path)
    return package.tree.read(path) == text.encode()
