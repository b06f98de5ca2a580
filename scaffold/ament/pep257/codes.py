"""The codes of pydocstyle 6.3.0, and which of them each linter reports."""

from __future__ import annotations

from collections.abc import Sequence

_ALL = """
    D100 D101 D102 D103 D104 D105 D106 D107 D200 D201 D202 D203 D204 D205 D206 D207 D208 D209 D210
    D211 D212 D213 D214 D215 D300 D301 D302 D400 D401 D402 D403 D404 D405 D406 D407 D408 D409 D410
    D411 D412 D413 D414 D415 D416 D417 D418 D419
"""
ALL = frozenset(_ALL.split())
MISSING = frozenset(code for code in ALL if code.startswith("D10"))
"""The codes of missing docstrings."""
AMENT = ALL - MISSING - {"D203", "D212", "D404"}
"""The default codes of ament_pep257."""
UNUSUAL = ALL - AMENT
"""The codes only enabled by a package's own configuration."""

_NOT_PEP257 = """
    D203 D212 D213 D214 D215 D404 D405 D406 D407 D408 D409 D410 D411 D413 D415 D416 D417 D418
"""
_NOT_NUMPY = "D107 D203 D212 D213 D402 D413 D415 D416 D417"
_NOT_GOOGLE = "D203 D204 D213 D215 D400 D401 D404 D406 D407 D408 D409 D413"
CONVENTIONS = {
    "google": ALL - frozenset(_NOT_GOOGLE.split()),
    "numpy": ALL - frozenset(_NOT_NUMPY.split()),
    "pep257": ALL - frozenset(_NOT_PEP257.split()),
}


def chosen(
    ignored: Sequence[str],
    selected: Sequence[str],
    more_ignored: Sequence[str],
    more_selected: Sequence[str],
    *,
    convention: str,
) -> frozenset[str]:
    """Return the codes that ament_pep257 reports for its flags."""
    if ignored:
        codes = ALL - _matching(ignored)
    elif selected:
        codes = _matching(selected)
    else:
        codes = CONVENTIONS.get(convention, AMENT)
    return (codes | _matching(more_selected)) - _matching(more_ignored)


def _matching(words: Sequence[str]) -> frozenset[str]:
    prefixes = [part.strip() for word in words for part in word.split(",")]
    return frozenset(code for code in ALL if code.startswith((*filter(None, prefixes),)))
