"""Derives answers to the questions of templates from an existing package."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Sequence
from itertools import dropwhile

from scaffold import lazy_re
from scaffold.ament import copyright as notices
from scaffold.errors import InputError
from scaffold.files.tree import MANIFEST
from scaffold.generate.own_sources import license_texts, majority, own_headers
from scaffold.generate.questions import answer_types
from scaffold.generate.questions.questions import Given
from scaffold.model.manifest.manifest import Manifest
from scaffold.model.manifest.placeholders import is_placeholder
from scaffold.model.manifest.spdx import spdx_of
from scaffold.model.package import Package

_BSD = "Redistribution and use in source and binary forms"
_THIRD_CLAUSE = "either the name of"
_NOTICE = lazy_re.compile(r"(?im)^[ \t]*copyright\b(.*)$")
_YEAR = lazy_re.compile(r"(?i)(?:\(c\)|©)?[\d,-]*")
"""A year or the like between "copyright" and the holder."""
_ENDED = lazy_re.compile(r"(?<!\bInc)(?<!\bLtd)(?<!\bCo)(?<!\bCorp)(?<!\be\.V)\.$")
"""The period at the end of a sentence, but not that of "Inc."."""
_AUTHOR = lazy_re.compile(r"(?i)#[\s*]*[@\\]?(authors?|written by)\b")
_OF_TEXTS = ("free software foundation",)
"""Holders of license texts, not of the licensed code."""
_ACCOUNTS = frozenset({"root", "user", "ubuntu", "ros", "admin", "vscode", "none", "unknown"})
"""Default accounts of containers, which `ros2 pkg create` writes as the maintainer's name."""
_OF_EXAMPLES = ("open source robotics foundation", "open robotics", "willow garage")
"""Holders named in copied examples and tutorials, and in code ported from ROS 1."""
_OF_OPEN_ROBOTICS = ("openrobotics.org", "osrfoundation.org")


def answers(package: Package, licenses: Sequence[str]) -> dict[str, Given]:
    """Return the answers implied by a package: its license, copyright holder and maintainer.

    Args:
        package: The package; its manifest can be parsed.
        licenses: The licenses that there are templates for.
    """
    maintainer, address = _maintainer(package.manifest)
    decided = {
        "license": license_of(package, licenses),
        "copyright_holder": _copyright_holder(package) or _holder_in_text(package) or maintainer,
        "maintainer_name": maintainer,
        "maintainer_email": address,
    }
    return {name: Given(value, MANIFEST) for name, value in decided.items() if value is not None}


def license_of(package: Package, templates: Sequence[str]) -> str | None:
    """Return the license of a package, if there is a template for it.

    The manifest decides; where it says too little (``BSD``) or nothing, the headers of the
    package's own sources do, then the text of the license, in the package or at the top of its
    repository. Where it says TODO, or all of them leave a choice, nothing is decided.
    """
    if not is_decided(package):
        return None
    declared = [
        spdx_of(element.text) or (element.text,) for element in package.manifest.all("license")
    ]
    choices = {
        spelling for spellings in declared for spelling in spellings if spelling in templates
    }
    if len(choices) == 1:
        return choices.pop()
    written = Counter(
        header.license for header in own_headers(package) if header.license in templates
    )
    for license_, _ in written.most_common():
        if license_ in choices or not choices:
            return license_
    named = {identify_text(data) for data in license_texts(package)}
    named &= choices or {*templates}
    return named.pop() if len(named) == 1 else None


def identify_text(data: bytes) -> str | None:
    """Return the license with a text; BSD licenses are distinguished by their clauses."""
    license_ = notices.identify_file("LICENSE", data)
    text = " ".join(data.decode("utf-8", "replace").split())
    if license_ is not None or _BSD not in text:
        return license_
    return "BSD-3-Clause" if _THIRD_CLAUSE in text else "BSD-2-Clause"


def is_decided(package: Package) -> bool:
    """Return whether the manifest has a license other than a placeholder."""
    return not any(is_placeholder(element.text) for element in package.manifest.all("license"))


def own_header(package: Package) -> str:
    """Return the comment with the copyright notice that most own Python files begin with.

    It is empty where the license is not decided, or where the files do not agree.
    """
    headers = [header for header in own_headers(package) if header.path.endswith(".py")]
    comments = (
        _comment(package.source(header.path).lines, header.location.line - 1)
        for header in headers
        if any(_may_hold(package, name) for name in header.holders)
    )
    return (majority(comments, len(headers)) or "") if is_decided(package) else ""


def _comment(lines: Sequence[str], number: int) -> str:
    """Return the comment lines around a line, without the author.

    Paragraphs of a license that empty lines keep apart are one comment.
    """
    start = end = number
    while start and lines[start - 1].startswith("#") and not lines[start - 1].startswith("#!"):
        start -= 1
    for at in range(number, len(lines)):
        if lines[at].strip() and not lines[at].startswith("#"):
            break
        if at <= end or "license" in lines[at].lower():
            end = _end_of_comment(lines, at)
    return "\n".join(line.rstrip() or "#" for line in lines[start:end] if not _AUTHOR.match(line))


def _end_of_comment(lines: Sequence[str], start: int) -> int:
    """Return the number of the line after a comment."""
    return next(
        (at for at in range(start, len(lines)) if not lines[at].startswith("#")), len(lines)
    )


def _copyright_holder(package: Package) -> str | None:
    """Return the copyright holder of most own sources, counting those without a notice.

    If several are equally frequent, it is the first one.
    """
    headers = own_headers(package)
    holders = (dict.fromkeys(map(_without_remark, header.holders)) for header in headers)
    names = (name for of_file in holders for name in of_file)
    holder = majority(names, len(headers))
    if holder is None or not _is_usable(holder) or not _may_hold(package, holder):
        return None
    return holder


def _holder_in_text(package: Package) -> str | None:
    """Return the copyright holder in the license text, if there is only one."""
    texts = [data.decode("utf-8", "replace") for data in license_texts(package)]
    lines = [line for text in texts for line in _NOTICE.findall(text)]
    names = {_ENDED.sub("", _without_remark(name)) for name in map(_named, lines) if name}
    names = {name for name in names if not name.lower().startswith(_OF_TEXTS)}
    holder = names.pop() if len(names) == 1 else ""
    return holder if _is_usable(holder) and _may_hold(package, holder) else None


def _named(notice: str) -> str:
    """Return the holder in the text after the word "copyright"; empty without a year."""
    words = notice.split()
    holder = [*dropwhile(_YEAR.fullmatch, words)]
    has_year = any(character.isdigit() for word in words[: -len(holder)] for character in word)
    return " ".join(holder) if has_year else ""


def _may_hold(package: Package, name: str) -> bool:
    """Return whether a notice may be by the package's authors, not by those they copied from."""
    if not name.lower().startswith(_OF_EXAMPLES):
        return True
    maintainers = package.manifest.all("maintainer")
    return any(
        (maintainer.get("email") or "").endswith(_OF_OPEN_ROBOTICS) for maintainer in maintainers
    )


def _without_remark(name: str) -> str:
    """Return the name of a holder without remarks such as "All rights reserved"."""
    remark = r"[.,]?\s*\b(all rights reserved|see (the )?licen[sc]e)\b.*$"
    return re.sub(remark, "", name, flags=re.IGNORECASE).strip()


def _maintainer(manifest: Manifest) -> tuple[str | None, str | None]:
    """Return the name and the address of the first maintainer, if they are valid."""
    element = manifest.one("maintainer")
    if element is None:
        return None, None
    email = element.get("email") or ""
    try:
        address: str | None = answer_types.address(email)
    except InputError:
        address = None
    is_person = _is_usable(element.text) and not is_placeholder(element.text)
    is_person = is_person and element.text.lower() not in _ACCOUNTS
    return (element.text if is_person else None), address


def _is_usable(name: str) -> bool:
    try:
        return bool(answer_types.person(name))
    except InputError:
        return False
