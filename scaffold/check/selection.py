"""Resolves ``--select`` and ``--ignore``: codes, prefixes, names, areas or ``ALL``."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Mapping, Sequence
from difflib import get_close_matches
from fnmatch import fnmatchcase
from typing import TYPE_CHECKING

from scaffold.check.rules.renamed_codes import new_codes
from scaffold.errors import ConfigError
from scaffold.record import NamedTuple

if TYPE_CHECKING:
    from scaffold.check.rules.rule import Rule

ALL = "ALL"
"""The word for all codes."""
_TAKEN_FOR_DIGITS = str.maketrans("OIL", "011")

UNCHECKED = ("SC001", "SC002", "SC004", "SC005", "SC007")
"""Codes that report unchecked input, shown even if other codes are selected."""


class Selection(NamedTuple):
    """Code prefixes to report and to ignore."""

    select: tuple[str, ...] = ()
    """The selected prefixes; empty for all."""
    ignore: tuple[str, ...] = ()
    per_path: Mapping[str, tuple[str, ...]] = {}
    """Prefixes to ignore, by a pattern of paths relative to a package or to ``origin``."""
    origin: str = ""
    """The configuration file with these patterns."""

    def wants(self, code: str) -> bool:
        """Return whether a code is reported; the longer of two matching prefixes decides."""
        chosen = _longest(self.select, code) if self.select and code not in UNCHECKED else 0
        ignored = _longest(self.ignore, code)
        return chosen is not None and chosen > (-1 if ignored is None else ignored)

    def wants_at(self, code: str, paths: Collection[str]) -> bool:
        """Return whether a code is reported in a file.

        Args:
            code: The code.
            paths: The path of the file relative to its package, and to ``origin`` if it is below.
        """
        return not any(
            code.startswith(prefixes)
            for pattern, prefixes in self.per_path.items()
            if any(fnmatchcase(path, pattern.removeprefix("./")) for path in paths)
        )


def area_prefixes(rules: Iterable[type[Rule]]) -> dict[str, str]:
    """Return the code prefixes of areas by the name of the directory.

    Args:
        rules: The rules of content directories; those of the engine are in no area.
    """
    return {
        rule.__module__.split(".")[1]: rule.code[:2]
        for rule in rules
        if not rule.__module__.startswith("scaffold.")
    }


def resolve(
    words: Iterable[str], names: Mapping[str, str], areas: Mapping[str, str], origin: str
) -> tuple[str, ...]:
    """Return the code prefixes that match words.

    Args:
        words: Codes, prefixes of codes, names of rules, areas, or ``ALL``, in any case.
        names: The names of all rules by their codes.
        areas: The prefix of the codes of each area by its name.
        origin: The origin of the words.

    Raises:
        ConfigError: a word matches no rule.
    """
    result: dict[str, None] = {}
    for word in words:
        upper, lower = word.upper(), word.lower()
        codes = [code for code, name in names.items() if name == lower]
        if upper == ALL:
            codes = [""]
        elif any(code.startswith(upper) for code in names):
            codes = [upper]
        elif lower in areas:
            codes = [areas[lower]]
        if not codes:
            is_name = "-" in word or not any(map(str.isdigit, word))
            candidates = [*areas, *names.values()] if is_name else list(names)
            kind = "name" if is_name else "code"
            hint = nearest(lower if is_name else upper, candidates)
            raise ConfigError(f"{origin}: no rule has the {kind} {word!r}{hint}")
        result.update(dict.fromkeys(codes))
    return tuple(result)


def nearest(word: str, choices: Collection[str]) -> str:
    """Return the end of an error message: the code that replaces a word, or the closest ones."""
    renamed = new_codes(word.upper())
    if renamed:
        return f"; renamed to {', '.join(renamed)}"
    typed = word[:2] + word[2:].translate(_TAKEN_FOR_DIGITS)
    closest = [typed] if typed in choices else get_close_matches(word, choices, n=3, cutoff=0.5)
    return f"; did you mean {', '.join(closest)}?" if closest else "; see `ros2-scaffold rules`"


def split(values: Sequence[str] | None) -> list[str]:
    """Return the words of a repeatable, comma-separated flag."""
    return [word for value in values or () for word in re.split(r"[,\s]+", value) if word]


def _longest(prefixes: Iterable[str], code: str) -> int | None:
    """Return the length of the longest prefix of ``code``, or ``None``."""
    return max((len(prefix) for prefix in prefixes if code.startswith(prefix)), default=None)
