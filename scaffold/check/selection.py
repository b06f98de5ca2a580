"""Which codes are asked for: ``--select`` and ``--ignore`` by prefix, as flake8 and ruff do."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Mapping, Sequence
from difflib import get_close_matches
from fnmatch import fnmatchcase

from scaffold.check.renamed_codes import new_codes
from scaffold.errors import ConfigError
from scaffold.record import NamedTuple

UNCHECKED = ("SC001", "SC002", "SC004", "SC005")
"""What says that something was not checked: whoever selects other codes must hear it, too."""


class Selection(NamedTuple):
    """Code prefixes to report, and where not."""

    select: tuple[str, ...] = ()
    """Empty for everything."""
    ignore: tuple[str, ...] = ()
    per_path: Mapping[str, tuple[str, ...]] = {}
    """Prefixes to ignore, by a pattern of paths relative to the package's root."""

    def wants(self, code: str) -> bool:
        """Tell whether a code is reported; the longer of two matching prefixes decides."""
        chosen = _longest(self.select, code) if self.select and code not in UNCHECKED else 0
        return chosen is not None and chosen > (_longest(self.ignore, code) or -1)

    def wants_at(self, code: str, path: str) -> bool:
        """Tell whether a code is reported in a file."""
        return not any(
            code.startswith(prefixes)
            for pattern, prefixes in self.per_path.items()
            if fnmatchcase(path, pattern)
        )


def validate(prefixes: Iterable[str], codes: Collection[str], origin: str) -> None:
    """Raise ConfigError for a prefix that fits no code, with the nearest ones."""
    for prefix in prefixes:
        if any(code.startswith(prefix) for code in codes):
            continue
        raise ConfigError(f"{origin}: no rule has the code {prefix!r}{nearest(prefix, codes)}")


def nearest(word: str, known: Collection[str]) -> str:
    """Return the end of an error message: what replaces a word, or the known ones next to it."""
    renamed = new_codes(word.upper())
    if renamed:
        return f"; renamed to {', '.join(renamed)}"
    near = get_close_matches(word, known, n=3, cutoff=0.5)
    return f"; did you mean {', '.join(near)}?" if near else "; see `ros2-scaffold rules`"


def split(values: Sequence[str] | None) -> tuple[str, ...]:
    """Return the codes of a repeatable, comma-separated flag in upper case."""
    return tuple(
        code.upper() for value in values or () for code in re.split(r"[,\s]+", value) if code
    )


def _longest(prefixes: Iterable[str], code: str) -> int | None:
    """Return the length of the longest prefix of ``code``, or ``None``."""
    return max((len(prefix) for prefix in prefixes if code.startswith(prefix)), default=None)
