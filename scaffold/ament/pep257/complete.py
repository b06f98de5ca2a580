"""Runs pydocstyle itself, for codes that the reimplementation lacks.

Codes for missing docstrings, and options such as ignored decorators, are in no default
configuration. If a package enables them, pydocstyle checks the file as well; for findings of both,
our messages, locations and fixes are used.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import TYPE_CHECKING

from scaffold.ament.finding import FLAKE8, PEP257, Finding
from scaffold.ament.flake8.options import PROPERTIES
from scaffold.ament.pep257 import codes
from scaffold.ament.pep257 import form as docstrings
from scaffold.ament.python_text.text import PythonText

if TYPE_CHECKING:
    from scaffold.ament.flake8.options import Options
    from scaffold.ament.settings import Settings

Places = set[tuple[int, str]]
"""Lines and codes."""


def is_needed(settings: Settings) -> bool:
    """Return whether pydocstyle has to run."""
    options = settings.flake8
    if settings.linters & PEP257 and not settings.pep257 <= codes.AMENT:
        return True
    if not settings.linters & FLAKE8 or options.docstring_convention != "pep257":
        return bool(settings.linters & FLAKE8) and options.reports_any([*codes.ALL])
    is_unusual = options.ignore_decorators or options.property_decorators != PROPERTIES
    return bool(is_unusual) or options.reports_any([*codes.UNUSUAL & codes.CONVENTIONS["pep257"]])


def check(text: PythonText, settings: Settings) -> Iterator[Finding]:
    """Yield the findings about the docstrings of a file, with the linters that report them."""
    own = {(item.line, item.code): item for item in docstrings.check(text)}
    flake8 = _of_flake8(text, settings.flake8) if settings.linters & FLAKE8 else set()
    pep257 = _places(text) if settings.linters & PEP257 else set()
    if flake8 is None or pep257 is None:  # pydocstyle fails on the file
        yield from own.values()
        return
    for line, code in sorted(flake8 | pep257):
        linters = FLAKE8 * ((line, code) in flake8) | PEP257 * ((line, code) in pep257)
        finding = own.get((line, code)) or Finding(code, line, 1)
        yield finding._replace(linters=linters)


def _of_flake8(text: PythonText, options: Options) -> Places | None:
    decorators = options.ignore_decorators
    places = _places(
        text,
        ignore_decorators=re.compile(decorators) if decorators else None,
        property_decorators=set(options.property_decorators.split(",")),
        ignore_inline_noqa=True,
        ignore_self_only_init=options.ignore_self_only_init,
    )
    convention = codes.CONVENTIONS.get(options.docstring_convention, codes.ALL)
    return None if places is None else {place for place in places if place[1] in convention}


def _places(text: PythonText, **options: object) -> Places | None:
    """Return the findings of pydocstyle; ``None`` if it fails."""
    from scaffold.ament.pep257.reference import load

    pydocstyle = load()
    source = "".join(text.lines)
    try:
        violations = [*pydocstyle.ConventionChecker().check_source(source, text.name, **options)]
    except Exception:  # noqa: BLE001  whatever pydocstyle stumbles over
        return None
    return {(violation.line, violation.code) for violation in violations}
