"""Merges template changes into a package that was generated earlier."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from typing import NamedTuple

from scaffold.configuration import git_content
from scaffold.configuration.content import is_url
from scaffold.distributions import Distribution
from scaffold.errors import InputError
from scaffold.files.tree import Tree
from scaffold.formats.conflicts import first_conflict
from scaffold.generate import draft
from scaffold.generate.draft import Draft
from scaffold.generate.parts import ADD, KIND
from scaffold.generate.questions import questions
from scaffold.generate.questions.defaults import DISTRO, User
from scaffold.generate.questions.questions import Given
from scaffold.generate.repository import MARK, NOWHERE, Place, is_below, place_of_files
from scaffold.generate.repository import read as read_file
from scaffold.generate.templates.template import Template
from scaffold.generate.update.branches import Parts, joined
from scaffold.generate.update.merge import MARKS, merge
from scaffold.generate.update.provenance import (
    ATTRIBUTES,
    HIDDEN,
    NAME,
    Provenance,
    parse,
)
from scaffold.writing.transaction import BASES


class Updated(NamedTuple):
    """A package updated to the current templates, in memory."""

    files: Mapping[str, bytes]
    """The files to write: changed ones, and the record with its sidecar."""
    executable: frozenset[str]
    conflicts: Mapping[str, int]
    """The number of conflicts of a file, by path."""
    remarks: tuple[str, ...]
    """Notes for the user, one line each."""

    @property
    def changed(self) -> list[str]:
        """The changed files, besides the record and its sidecar."""
        return [path for path in self.files if path not in HIDDEN]


def update(
    tree: Tree,
    where: str,
    roots: Sequence[str],
    templates: Mapping[str, Template],
    user: User,
    place: Place = NOWHERE,
    *,
    moved: Sequence[Distribution] | None = None,
) -> Updated:
    """Merge the difference between the recorded and the newly rendered files into the user's.

    Args:
        tree: The package.
        where: Its directory, for messages.
        roots: The ``templates`` directories; a later one wins.
        templates: The templates in them.
        user: Supplies answers to new questions.
        place: The git repository that the package is in.
        moved: The new target distributions, if they are to change.

    Raises:
        InputError: the package has no record, a damaged one, or answers that the current
            templates do not accept.
        ContentError: a template is broken.
    """
    provenance = read(tree, where)
    remarks: list[str] = []
    given = recorded(provenance, templates, where, remarks)
    if moved is not None:
        given[DISTRO] = Given([distribution.name for distribution in moved], "--distro")

    def drafted(parts: Parts) -> Draft:
        changed = {**given, ADD: given[ADD]._replace(value=parts)}
        return draft.draft(roots, templates, changed, user, provenance.date, place)

    made = drafted(given[ADD].value)
    provenance = joined(provenance, lambda parts: drafted(parts).rendered.files)
    paths = {*provenance.rendered, *provenance.lost, *made.rendered.files}
    present = _present(tree, where, place, paths)
    _refuse_undecided(present, where, made)
    now = {path: text.encode() for path, text in made.rendered.files.items()}
    provenance = provenance.completed(now).completed(present)
    refuse_lost(provenance, where, now.keys() & present.keys())
    files, conflicts = _merged(present, provenance, made, remarks)
    is_moved = moved is not None and provenance.answers.get(DISTRO) != made.answers.get(DISTRO)
    has_attributes = ATTRIBUTES in {*files, *tree.files}
    files |= _record(provenance, made, is_moved=is_moved, has_attributes=has_attributes)
    executable = made.rendered.executable.intersection(files)
    return Updated(files, executable, conflicts, (*remarks, *made.conflicts))


def recorded_content(tree: Tree, where: str, given: Sequence[str]) -> list[str]:
    """Return the git repositories of the templates of a package, as given to ``--content``.

    Args:
        tree: The package.
        where: Its directory, for messages.
        given: Content given by the user; its revision of a repository takes precedence.

    Raises:
        InputError: the record is damaged, or has two revisions of a repository.
    """
    if NAME not in tree.files:
        return []
    urls = {git_content.split(text)[0] for text in given if is_url(text)}
    sources: dict[str, str] = {}
    for source in read(tree, where).sources:
        if source.url in urls:
            continue
        if sources.setdefault(source.url, source.revision) != source.revision:
            raise InputError(
                f"{where}/{NAME}: two branches used different revisions of {source.url}; choose "
                f"one with --content {source.url}@{source.revision}"
            )
    return [f"{url}@{revision}" for url, revision in sources.items()]


def read(tree: Tree, where: str) -> Provenance:
    """Return the record of a package.

    Raises:
        InputError: there is none, or it is damaged.
    """
    path = f"{where}/{NAME}"
    if NAME not in tree.files:
        raise InputError(
            f"{path} is missing: `update` only works on packages created by `ros2-scaffold new`"
        )
    try:
        record = tree.read(NAME).decode()
        path = f"{where}/{BASES}"
        sidecar = tree.read(BASES).decode() if BASES in tree.files else None
    except (OSError, UnicodeDecodeError) as error:
        raise InputError(f"{path}: {error}") from error
    return parse(record, f"{where}/{NAME}", sidecar)


def refuse_lost(provenance: Provenance, where: str, needed: Collection[str]) -> None:
    """Raise InputError if a needed base of a file is lost."""
    lost = sorted(provenance.lost.keys() & set(needed))
    if lost:
        raise InputError(
            f"{where}/{BASES}: lacks the rendered templates of {', '.join(lost)}, which are "
            "needed for the merge; restore the file from git; nothing was changed"
        )


def recorded(
    provenance: Provenance, templates: Mapping[str, Template], where: str, remarks: list[str]
) -> dict[str, Given]:
    """Return the recorded answers that the current templates still ask for."""
    origin = f"{where}/{NAME}"
    names = {question.name for question in questions.unique(templates.values())}
    given: dict[str, Given] = {}
    for name, value in provenance.answers.items():
        if name in names:
            given[name] = Given(value, f"{origin}: {name}")
        else:
            remarks.append(f"the templates no longer ask for {name}")
    parts = [
        _known_part(part, templates, origin, remarks) for part in provenance.answers.get(ADD, ())
    ]
    given[ADD] = Given(parts, f"{origin}: {ADD}")
    return given


def _known_part(
    part: Mapping[str, object], templates: Mapping[str, Template], origin: str, remarks: list[str]
) -> dict[str, object]:
    template = templates.get(str(part.get(KIND)))
    if template is None:
        raise InputError(
            f"{origin}: created with the template {part.get(KIND)!r}, which does not exist here; "
            "use --content with the directory, or the URL@REV, of its templates"
        )
    names = {KIND, *(question.name for question in template.questions)}
    remarks += [f"{template.name} no longer asks for {name}" for name in part if name not in names]
    return {name: value for name, value in part.items() if name in names}


def _present(tree: Tree, where: str, place: Place, paths: Iterable[str]) -> dict[str, bytes]:
    """Return the existing ones of some files, in the package or at the top of the repository."""
    files = set(tree.files)
    result: dict[str, bytes] = {}
    for path in filter(is_below, paths):
        content: bytes | None
        if path in files:
            content = tree.read(path)
        elif path.startswith(MARK):
            content = read_file(place, path.removeprefix(MARK))
        else:  # a tree has no hidden directories
            content = read_file(place_of_files(where), path)
        if content is not None:
            result[path] = content
    return result


def _refuse_undecided(present: Mapping[str, bytes], where: str, made: Draft) -> None:
    """Raise if a file has unresolved conflicts, which another merge would garble."""
    for path in sorted(present.keys() & set(made.rendered.files)):
        if all(mark.encode() in present[path] for mark in MARKS):
            raise InputError(
                f"{where}/{path}: has conflict markers from an earlier update; resolve them "
                "first; nothing was changed"
            )
        line = first_conflict(present[path].decode(errors="replace").split("\n"))
        if line:
            raise InputError(
                f"{where}/{path}: has conflict markers on line {line}; resolve the conflict "
                "first; nothing was changed"
            )


def _record(
    provenance: Provenance, made: Draft, *, is_moved: bool, has_attributes: bool
) -> dict[str, bytes]:
    """Return the files of the new record, if it differs from the present one."""
    written = Provenance.of(made)
    is_as_recorded = provenance.sources == written.sources and provenance.is_canonical
    if provenance.rendered == made.rendered.files and is_as_recorded and not is_moved:
        return {}
    record = written.files(is_new=not provenance.has_sidecar and not has_attributes)
    return {path: text.encode() for path, text in record.items()}


def _merged(
    present: Mapping[str, bytes], provenance: Provenance, made: Draft, remarks: list[str]
) -> tuple[dict[str, bytes], dict[str, int]]:
    files: dict[str, bytes] = {}
    conflicts: dict[str, int] = {}
    for path, text in made.rendered.files.items():
        before, now = provenance.rendered.get(path), text.encode()
        if before == text:
            continue
        if path not in present:
            if before is None and path not in provenance.lost:
                files[path] = now
            else:
                remarks.append(f"{path} changed in the templates, but you removed it")
            continue
        yours = present[path]
        merged = merge(yours, (before or "").encode(), now) if yours != now else None
        if merged is not None and merged.content != yours:
            files[path] = merged.content
            if merged.conflicts:
                conflicts[path] = merged.conflicts
    remarks += [
        f"{path} is no longer in the templates; remove it unless you need it"
        for path in [*provenance.rendered, *provenance.lost]
        if path in present and path not in made.rendered.files
    ]
    return files, conflicts
