"""What a package remembers of its making: the answers, and the files as they were written.

``update`` merges what changed in the templates since then. The templates of that day may be gone
when it is wanted, so the record holds what they gave (docs/adr/0007-packages-keep-their-origin.md).
"""

from __future__ import annotations

import base64
import json
import re
import zlib
from collections.abc import Mapping
from datetime import date
from typing import Any

from scaffold import __version__
from scaffold.errors import InputError
from scaffold.generate.draft import Draft
from scaffold.programs import installation
from scaffold.record import NamedTuple
from scaffold.writing.transaction import RECORD

NAME = RECORD
"""The record's path in a package."""

_ABOUT = (
    "How ros2-scaffold made this package, for `ros2-scaffold update`. Commit it, do not edit it."
)
_MOST = 20_000_000
"""Bytes of the files in a record; more is no package of ours."""


class Provenance(NamedTuple):
    """How a package was made."""

    date: date
    """The day that stands in its files."""
    answers: Mapping[str, Any]
    """As in an answers file."""
    rendered: Mapping[str, str]
    """The files as the templates gave them, by path."""
    version: str = __version__
    """Of this tool."""

    @classmethod
    def of(cls, made: Draft) -> Provenance:
        """Return the record of a package that is made now."""
        return cls(made.day, made.answers, made.rendered.files)

    def with_files(self, answers: Mapping[str, Any], rendered: Mapping[str, str]) -> Provenance:
        """Return the record of the same package with more in it, which is added now."""
        return Provenance(self.date, answers, rendered)

    def text(self) -> str:
        """Return the record as a file."""
        data = json.dumps(dict(self.rendered), ensure_ascii=False).encode()
        entries = {
            "about": _ABOUT,
            "version": self.version,
            "date": self.date.isoformat(),
            "answers": dict(self.answers),
            "rendered": base64.b64encode(zlib.compress(data, 9)).decode(),
        }
        return json.dumps(entries, indent=2, ensure_ascii=False) + "\n"


def parse(text: str, path: str) -> Provenance:
    """Return the record in a file.

    Args:
        text: What is in it.
        path: For messages.

    Raises:
        InputError: it is damaged, or a newer version of this tool wrote it.
    """
    try:
        entries = json.loads(text)
        _refuse_newer(str(entries["version"]), path)
        packed = zlib.decompressobj()
        data = packed.decompress(base64.b64decode(entries["rendered"]), _MOST)
        rendered = json.loads(data)
        day = date.fromisoformat(entries["date"])
        found = Provenance(day, entries["answers"], rendered, str(entries["version"]))
    except (ValueError, zlib.error, KeyError, TypeError, RecursionError) as error:
        raise InputError(f"{path}: damaged: {' '.join(str(error).split()) or 'cut off'}") from error
    texts = [*found.rendered, *found.rendered.values()] if isinstance(rendered, dict) else [None]
    if not (_are_answers(found.answers) and all(isinstance(one, str) for one in texts)):
        raise InputError(f"{path}: damaged: an entry has the wrong type")
    return found


def _refuse_newer(version: str, path: str) -> None:
    """Raise if a later release wrote a record: this one would take back what that one changed."""
    if _release(version) > _release(__version__):
        raise InputError(
            f"{path}: written by ros2-scaffold {version}, and this is {__version__}: install "
            f"{version} or later: bring its source up to date, then `{installation.command()}`"
        )


def _release(version: str) -> list[int]:
    """Return the numbers of a release, those of betas and the like left out."""
    release = re.match(r"\d+(\.\d+)*", version)
    numbers = [int(number) for number in release[0].split(".")] if release else []
    while numbers and not numbers[-1]:
        numbers.pop()
    return numbers


_MOST_DEEP = 10
"""Levels of answers; those of ours have four."""


def _depth(value: object) -> int:
    """Return how deep lists and mappings are nested; what is too deep is not looked at."""
    depth, level = 0, [value]
    while level and depth <= _MOST_DEEP:
        inner: list[object] = []
        for one in level:
            inner += one.values() if isinstance(one, dict) else one if isinstance(one, list) else ()
        depth, level = depth + 1, inner
    return depth


def _are_answers(answers: object) -> bool:
    """Tell whether answers have the form in which they are kept; each is judged later."""
    if not isinstance(answers, dict) or not isinstance(answers.get("package"), str):
        return False
    if _depth(answers) > _MOST_DEEP:
        return False
    parts = answers.get("add", [])
    return (
        all(isinstance(name, str) for name in answers)
        and isinstance(parts, list)
        and all(isinstance(part, dict) and isinstance(part.get("kind"), str) for part in parts)
    )
