"""SPDX license identifiers, and common other spellings of them."""

from __future__ import annotations

import re

from scaffold.model.catalog import is_one_slip

_SPELLINGS = {
    "apache": ("Apache-2.0",),
    "apache 2": ("Apache-2.0",),
    "apache 2.0": ("Apache-2.0",),
    "asl 2.0": ("Apache-2.0",),
    "boost": ("BSL-1.0",),
    "boost 1.0": ("BSL-1.0",),
    "boost software": ("BSL-1.0",),
    "boost software 1.0": ("BSL-1.0",),
    "bsl 1.0": ("BSL-1.0",),
    "bsd": ("BSD-2-Clause", "BSD-3-Clause"),
    "bsd 2 clause": ("BSD-2-Clause",),
    "bsd 2.0": ("BSD-2-Clause", "BSD-3-Clause"),
    "bsd 3 clause": ("BSD-3-Clause",),
    "bsd 3": ("BSD-3-Clause",),
    "3 clause bsd": ("BSD-3-Clause",),
    "2 clause bsd": ("BSD-2-Clause",),
    "cc0": ("CC0-1.0",),
    "gpl": ("GPL-2.0-only", "GPL-3.0-only"),
    "gpl 2": ("GPL-2.0-only", "GPL-2.0-or-later"),
    "gpl 2.0": ("GPL-2.0-only", "GPL-2.0-or-later"),
    "gplv2": ("GPL-2.0-only", "GPL-2.0-or-later"),
    "gpl 3": ("GPL-3.0-only", "GPL-3.0-or-later"),
    "gpl 3.0": ("GPL-3.0-only", "GPL-3.0-or-later"),
    "gplv3": ("GPL-3.0-only", "GPL-3.0-or-later"),
    "gnu gpl 3.0": ("GPL-3.0-only", "GPL-3.0-or-later"),
    "lgpl": ("LGPL-2.1-only", "LGPL-3.0-only"),
    "lgpl 2.1": ("LGPL-2.1-only", "LGPL-2.1-or-later"),
    "lgplv2.1": ("LGPL-2.1-only", "LGPL-2.1-or-later"),
    "lgpl 3": ("LGPL-3.0-only", "LGPL-3.0-or-later"),
    "lgpl 3.0": ("LGPL-3.0-only", "LGPL-3.0-or-later"),
    "lgplv3": ("LGPL-3.0-only", "LGPL-3.0-or-later"),
    "mit": ("MIT",),
    "expat": ("MIT",),
    "mit 0": ("MIT-0",),
    "mozilla public 2.0": ("MPL-2.0",),
    "mpl": ("MPL-2.0",),
    "mpl 2.0": ("MPL-2.0",),
}
_SHORTEST = 8
_NOISE = r"\b(?:the|license|licence|licensed|version|software|new|modified|simplified)\b"


def spdx_of(text: str) -> tuple[str, ...]:
    """Return the SPDX identifiers that match a spelling; empty if unknown.

    ``Apache License, Version 2.0`` means ``Apache-2.0``; ``BSD`` may be one of two, and ``GPLv3``
    does not say whether later versions are permitted.
    """
    plain = re.sub(r"[,;()\-_]+", " ", text.lower())
    plain = re.sub(r"\bv(?=\d)", "", plain)
    for candidate in (plain, re.sub(_NOISE, " ", plain)):
        result = _SPELLINGS.get(" ".join(candidate.split()))
        if result:
            return result
    return ()


def similar_license(text: str) -> str:
    """Return the SPDX identifier that a text misspells by one letter; empty without one.

    A digit or a separator is no typo, and short names are similar by chance.
    """
    if len(text) < _SHORTEST or spdx_of(text) or text.upper().startswith("AGPL"):
        return ""
    plain = _letters(text)
    identifiers = sorted({name for names in _SPELLINGS.values() for name in names})
    if plain in map(_letters, identifiers):
        return ""
    return next((name for name in identifiers if is_one_slip(text, name, digits=False)), "")


def _letters(text: str) -> str:
    return re.sub(r"[^a-z0-9]", "", text.lower())
