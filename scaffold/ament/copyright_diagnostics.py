"""Diagnostics about copyright notices, license headers and repository files."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator

from scaffold.ament.codes import diagnostic
from scaffold.ament.copyright import (
    CONTRIBUTING,
    LICENSE,
    REPOSITORY_FILES,
    Header,
    contributing,
    departure,
    headers,
    identify_file,
)
from scaffold.ament.use import linter_use
from scaffold.diagnostic import Diagnostic, Severity
from scaffold.edits import CreateFile, Fix
from scaffold.model.manifest.spdx import spdx_of
from scaffold.model.package import Package
from scaffold.source import ViewError

_CAUSE = "copyright"
_LIMIT = "it checks other files only"
"""Why ament_copyright does not report a file if a test passes paths to it."""


def diagnostics(package: Package, code: str) -> Iterator[Diagnostic]:
    """Yield the findings of ament_copyright with one code, as info if the linter is not run."""
    if code == "LY020":
        missing = [header for header in headers(package) if not header.holders]
        yield from _of_headers(package, code, missing, _no_notice)
    elif code == "LY021" and not _has_own_texts(package):
        unknown = [item for item in headers(package) if item.holders and not item.license]
        yield from _of_headers(package, code, unknown, _unknown_header)
    elif code != "LY021":
        yield from _of_repository(package, code)


def _has_own_texts(package: Package) -> bool:
    """Return whether a dependency extends the linter with licenses."""
    try:
        names = package.manifest.declared_names
    except ViewError:
        return False
    return any(name.endswith("_ament_copyright") for name in names)


def _of_headers(
    package: Package, code: str, faulty: list[Header], explain: Callable[[Header, int], str]
) -> Iterator[Diagnostic]:
    """Yield an error for each file that the linter checks, and one note for all others."""
    if not faulty:
        return
    use = linter_use(package, "copyright")
    passed_over = [header for header in faulty if not use.covers(header.path)]
    for header in faulty:
        if use.covers(header.path):
            message = f"{explain(header, -1)}: ament_copyright fails"
            yield diagnostic(code, header.location, message, cause=_CAUSE)
    if passed_over:
        limit = _LIMIT if use.paths else ""
        why = use.why_not or limit or "it is configured to exclude them"
        first, others = passed_over[0], len(passed_over) - 1
        message = f"{explain(first, others)}: ament_copyright would fail, but {why}"
        yield diagnostic(code, first.location, message, severity=Severity.INFO, cause=_CAUSE)


def _no_notice(header: Header, others: int) -> str:
    """Return the message; ``others`` counts more such files, -1 if each file has its own."""
    if others < 0:
        return header.unreadable or "no copyright notice in the first comment of this file"
    return f"no copyright notice here and in {others} more" if others else "no copyright notice"


def _unknown_header(header: Header, others: int) -> str:
    files = "file has" if others == 1 else "files have"
    more = f" (and {others} more {files} no known header)" if others > 0 else ""
    return f"{_reason(header.text)}{more}"


def _reason(text: str) -> str:
    if not text:
        return "no license header below the notice"
    difference = departure(text)
    if difference is not None:
        license_, expected, actual = difference
        return f'the header is not that of {license_}: "{actual}" instead of "{expected}"'
    if "SPDX-License-Identifier" in text:
        return "an SPDX line below the notice is not the header of a license"
    start = " ".join(text.split()[:5])
    return f'"{start} …" does not begin any known license header'


def _of_repository(package: Package, code: str) -> Iterator[Diagnostic]:
    if not _is_repository(package):
        return
    use = linter_use(package, "copyright")
    for name in REPOSITORY_FILES:
        wrong = _file_problem(package, name)
        at = package.start_of(name).location
        if not wrong:
            continue
        fix = _fix(package, name)
        if use.runs and not use.paths:
            yield diagnostic(code, at, f"{wrong}: ament_copyright fails", fix, cause=_CAUSE)
        else:
            message = f"{wrong}: ament_copyright would fail, but {use.why_not or _LIMIT}"
            yield diagnostic(code, at, message, fix, severity=Severity.INFO, cause=_CAUSE)


def _fix(package: Package, name: str) -> Fix | None:
    """Return the fix that writes a missing file with a text fixed by the license.

    It is a legal statement: package.xml and LICENSE must agree on the license.
    """
    if name != CONTRIBUTING or package.has(name) or not package.has(LICENSE):
        return None
    named = {element.text for element in package.manifest.all("license")}
    texts = {contributing(item) for text in named for item in spdx_of(text) or (text,)}
    text = texts.pop() if len(texts) == 1 else None
    license_ = identify_file(LICENSE, package.bytes_of(LICENSE))
    if text is None or license_ is None or identify_file(name, text.encode()) != license_:
        return None
    return Fix(f"Create the {name} of the license", (CreateFile(name, text),))


def _is_repository(package: Package) -> bool:
    if package.has(".git") or package.has(".hg"):
        return True
    root = package.place
    places = [os.path.join(root, name) for name in (".git", ".hg")] if root is not None else []
    return any(package.outside.exists(place) for place in places)


def _file_problem(package: Package, name: str) -> str:
    if not package.has(name):
        return f"the repository has no {name}"
    data = package.bytes_of(name)
    if not data:
        return f"{name} is empty"
    if identify_file(name, data) is None:
        return f"{name} is not, word for word, the text that goes with a known license"
    return ""
