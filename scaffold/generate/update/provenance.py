"""The record in a package: its answers, and a hash of each generated file.

``update`` merges the template changes since then. The old templates may not exist any more, so a
sidecar contains their output (docs/adr/0007-packages-keep-their-origin.md).
"""

from __future__ import annotations

import base64
import json
import re
import zlib
from collections.abc import Iterable, Mapping, Sequence
from datetime import date
from types import MappingProxyType
from typing import Any

from scaffold import __version__
from scaffold.configuration import content
from scaffold.errors import InputError
from scaffold.generate.draft import Draft
from scaffold.generate.parts import ADD
from scaffold.generate.update import bases
from scaffold.generate.update.bases import hash_of
from scaffold.programs import installation
from scaffold.record import NamedTuple
from scaffold.writing.transaction import BASES, RECORD

NAME = RECORD
"""The record's path in a package."""
ATTRIBUTES = ".gitattributes"
"""The path of the git attributes for merging the record and its sidecar."""
HIDDEN = (BASES, NAME)
"""Files that are not shown in diffs."""
PURPOSES = {
    ATTRIBUTES: f"how git merges the two {RECORD.rpartition('.')[0]} files",
    BASES: "the rendered templates, for `ros2-scaffold update`",
    NAME: "answers and hashes, for `ros2-scaffold update`",
}
"""The purpose of each file."""

_ABOUT = (
    "Answers and hashes of the files, for `ros2-scaffold update`. Commit this file; do not edit it."
)
_ATTRIBUTES = f"""\
# Keep the additions of both branches; `ros2-scaffold update` combines them.
{RECORD} merge=union
{BASES} merge=union linguist-generated
"""


class Source(NamedTuple):
    """A revision of a git repository that templates came from."""

    url: str
    revision: str
    """A tag, a branch or a commit, as the user named it."""
    commit: str


class Provenance(NamedTuple):
    """The record of how a package was generated."""

    date: date
    """The date in its files."""
    answers: Mapping[str, Any]
    """As in an answers file."""
    rendered: Mapping[str, str]
    """The files as rendered by the templates, by path."""
    version: str = __version__
    """Of this tool."""
    lost: Mapping[str, Sequence[str]] = MappingProxyType({})
    """The hashes of files missing from the sidecar, by path; several after a merge."""
    merged: Mapping[str, Sequence[str]] = MappingProxyType({})
    """The hashes of files that two branches have changed, by path."""
    is_canonical: bool = True
    """Whether the record has the current format."""
    has_sidecar: bool = True
    """Whether it has a sidecar; those of earlier versions have none."""
    sources: tuple[Source, ...] = ()
    """The git repositories that templates came from."""

    @classmethod
    def of(cls, made: Draft) -> Provenance:
        """Return the record of a new package."""
        return cls(made.day, made.answers, made.rendered.files).with_roots(made.roots)

    def with_files(self, answers: Mapping[str, Any], rendered: Mapping[str, str]) -> Provenance:
        """Return the record with more files, which are being added."""
        return Provenance(self.date, answers, rendered, sources=self.sources)

    def with_roots(self, roots: Sequence[str]) -> Provenance:
        """Return the record with the sources of the templates that are now used."""
        now = [Source(item.url, item.name, item.commit) for item in content.revisions(roots)]
        urls = {source.url for source in now}
        others = [source for source in self.sources if source.url not in urls]
        return self._replace(sources=(*others, *now))

    def completed(self, candidates: Mapping[str, bytes]) -> Provenance:
        """Return the record with lost files that are found elsewhere.

        Args:
            candidates: Files by path; one is only used if it has the recorded hash.
        """
        matching = {
            path: candidates[path].decode(errors="replace")
            for path, hashes in self.lost.items()
            if path in candidates and [hash_of(candidates[path])] == list(hashes)
        }
        lost = {path: hashes for path, hashes in self.lost.items() if path not in matching}
        return self._replace(rendered={**self.rendered, **matching}, lost=lost)

    def files(self, *, is_new: bool) -> dict[str, str]:
        """Return the record and its sidecar as files.

        Args:
            is_new: Whether there is no sidecar yet, so that git attributes are needed.
        """
        attributes = {ATTRIBUTES: _ATTRIBUTES} if is_new else {}
        return {**attributes, BASES: bases.text(self.rendered), NAME: self.text()}

    def text(self) -> str:
        """Return the text of the record, in which every line can be merged by itself.

        Growing lists always have the same last entry: git keeps the new lines of both sides of
        a merge, and each of them ends in a comma.
        """
        parts = self.answers.get(ADD, [])
        others = sorted(item for item in self.answers.items() if item[0] != ADD)
        sources = [f"    {_json(source._asdict())}," for source in self.sources]
        hashes = [(path, hash_of(text.encode())) for path, text in sorted(self.rendered.items())]
        return "\n".join(
            [
                "{",
                f'  "about": {_json(_ABOUT)},',
                f'  "version": {_json(self.version)},',
                f'  "date": {_json(self.date.isoformat())},',
                '  "answers": {',
                *(f"    {_json(name)}: {_json(value)}," for name, value in others),
                f"    {_json(ADD)}: [",
                *(f"      {_json(part)}," for part in parts),
                "      null",
                "    ]",
                "  },",
                *(['  "content": [', *sources, "    null", "  ],"] if sources else []),
                '  "files": {',
                *(f"    {_json(path)}: {_json(hash_)}," for path, hash_ in hashes),
                '    "": null',
                "  }",
                "}\n",
            ]
        )


def _json(value: object) -> str:
    return json.dumps(value, ensure_ascii=False)


def parse(text: str, path: str, sidecar: str | None = None) -> Provenance:
    """Return the record in a file.

    Args:
        text: Its content.
        path: For messages.
        sidecar: The file next to it; ``None`` if there is none.

    Raises:
        InputError: it is damaged, has a merge conflict, or a newer version of this
            tool wrote it.
    """
    bases.refuse_conflict(text, path)
    try:
        entries = json.loads(text, object_pairs_hook=_merged_entries)
        version = _newest(entries["version"])
        _refuse_newer(version, path)
        day = date.fromisoformat(entries["date"])
        answers = _merged_answers(entries["answers"])
        if "rendered" in entries:
            old = _unpacked(entries["rendered"])
            return Provenance(day, answers, old, version, is_canonical=False, has_sidecar=False)
        hashes = _hashes(entries["files"])
        sources = _sources(entries.get("content", []))
    except _TypeError as error:
        raise InputError(f"{path}: damaged: an entry has the wrong type") from error
    except (ValueError, zlib.error, KeyError, TypeError, RecursionError) as error:
        raise InputError(f"{path}: damaged: {' '.join(str(error).split()) or 'cut off'}") from error
    where = f"{path.removesuffix(NAME)}{BASES}" if path.endswith(NAME) else BASES
    texts = bases.parse(sidecar, where) if sidecar is not None else {}
    lost = {
        name: several
        for name, several in hashes.items()
        if not all((name, hash_) in texts for hash_ in several)
    }
    rendered = {
        name: bases.combined([texts[name, hash_] for hash_ in several])
        for name, several in hashes.items()
        if name not in lost
    }
    merged = {name: several for name, several in hashes.items() if len(several) > 1}
    is_agreed = answers.keys() == entries["answers"].keys()
    is_canonical = is_agreed and not lost and not merged
    return Provenance(day, answers, rendered, version, lost, merged, is_canonical, sources=sources)


class _TypeError(Exception):
    """An entry of a record has the wrong type."""


_MAX_SIDES = 100
"""The maximum number of duplicates of an entry, and of items of merged lists."""


def _merged_entries(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    """Return a JSON object; a merge may have kept an entry of both sides.

    Lists are joined; other duplicates become a tuple, which JSON does not have.
    """
    entries: dict[str, Any] = {}
    for name, value in pairs:
        old = entries.get(name, value)
        if isinstance(old, (list, tuple)) and len(old) > _MAX_SIDES and name in entries:
            raise _TypeError
        if isinstance(old, list) and isinstance(value, list) and name in entries:
            entries[name] = [*old, *(item for item in value if item not in old)]
        elif isinstance(old, tuple):
            entries[name] = old if value in old else (*old, value)
        else:
            entries[name] = value if old == value else (old, value)
    return entries


def _newest(version: object) -> str:
    return max(map(str, version if isinstance(version, tuple) else [version]), key=_release)


def _merged_answers(answers: object) -> dict[str, Any]:
    """Return the answers without those that differ between the sides of a merge.

    These are derived again: the description, unless the user has given one.
    """
    if not isinstance(answers, dict):
        raise _TypeError
    agreed = {name: value for name, value in answers.items() if not isinstance(value, tuple)}
    if isinstance(agreed.get(ADD), list):
        agreed[ADD] = [part for part in agreed[ADD] if part is not None]
    if not _are_answers(agreed):
        raise _TypeError
    return agreed


def _hashes(entries: object) -> dict[str, tuple[str, ...]]:
    """Return the hashes of each file."""
    if not isinstance(entries, dict):
        raise _TypeError
    hashes = {
        path: value if isinstance(value, tuple) else (value,)
        for path, value in entries.items()
        if path
    }
    if not all(isinstance(hash_, str) for several in hashes.values() for hash_ in several):
        raise _TypeError
    _refuse_surrogates(hashes)
    return hashes


def _sources(entries: object) -> tuple[Source, ...]:
    """Return the git repositories of the templates."""
    if not isinstance(entries, list):
        raise _TypeError
    sources = [entry for entry in entries if entry is not None]
    for entry in sources:
        if not isinstance(entry, dict) or {*entry} != {*Source._fields}:
            raise _TypeError
        if not all(isinstance(value, str) for value in entry.values()):
            raise _TypeError
    return tuple(Source(**entry) for entry in sources)


def _unpacked(packed: str) -> dict[str, str]:
    """Return the files of a record without a sidecar."""
    decoder = zlib.decompressobj()
    files = json.loads(decoder.decompress(base64.b64decode(packed), bases.MOST))
    if not isinstance(files, dict) or not all(isinstance(text, str) for text in files.values()):
        raise _TypeError
    _refuse_surrogates([*files, *files.values()])
    return files


def _refuse_surrogates(texts: Iterable[str]) -> None:
    """Raise ValueError for lone surrogates, which JSON allows but no file can contain."""
    for text in texts:
        text.encode()


def _refuse_newer(version: str, path: str) -> None:
    """Raise if a later release wrote a record: this one would revert its changes."""
    if _release(version) > _release(__version__):
        raise InputError(
            f"{path}: written by ros2-scaffold {version}, but this is {__version__}; install "
            f"{version} or later: update its source, then run `{installation.command()}`"
        )


def _release(version: str) -> list[int]:
    """Return the numbers of a version, without pre-release parts."""
    release = re.match(r"\d+(\.\d+)*", version)
    numbers = [int(number) for number in release[0].split(".")] if release else []
    while numbers and not numbers[-1]:
        numbers.pop()
    return numbers


_MAX_DEPTH = 10
"""The maximum depth of answers; generated ones have four levels."""


def _depth(value: object) -> int:
    """Return the nesting depth of lists and mappings, up to a limit.

    A tuple, which is an entry that differs between two sides of a merge, is too deep anywhere.
    """
    depth, level = 0, [value]
    while level and depth <= _MAX_DEPTH:
        if any(isinstance(item, tuple) for item in level):
            return _MAX_DEPTH + 1
        inner: list[object] = []
        for element in level:
            inner += (
                element.values()
                if isinstance(element, dict)
                else element
                if isinstance(element, list)
                else ()
            )
        depth, level = depth + 1, inner
    return depth


def _are_answers(answers: object) -> bool:
    """Return whether answers have the right structure; each is validated later."""
    if not isinstance(answers, dict) or not isinstance(answers.get("package"), str):
        return False
    if _depth(answers) > _MAX_DEPTH:
        return False
    parts = answers.get("add", [])
    return (
        all(isinstance(name, str) for name in answers)
        and isinstance(parts, list)
        and all(isinstance(part, dict) and isinstance(part.get("kind"), str) for part in parts)
    )
