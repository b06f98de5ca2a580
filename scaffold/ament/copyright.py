"""Copyright notices and license headers of source files, as ament_copyright parses them."""

from __future__ import annotations

import os
import re
from contextlib import suppress
from functools import lru_cache

from scaffold import distributions
from scaffold.ament.files import broken_links, lintable
from scaffold.configuration import content
from scaffold.distributions import DATA
from scaffold.files.disk import LargeFileError
from scaffold.model.facts import fact
from scaffold.model.package import Package
from scaffold.model.remembered import remembered
from scaffold.record import NamedTuple
from scaffold.source import Location, ViewError

EXTENSIONS = frozenset({".c", ".cc", ".cpp", ".cxx", ".h", ".hh", ".hpp", ".hxx", ".cmake", ".py"})
CONTRIBUTING = "CONTRIBUTING.md"
LICENSE = "LICENSE"
REPOSITORY_FILES = (CONTRIBUTING, LICENSE)

_LICENSES = os.path.join(DATA, "licenses.tsv")
_YEARS = r"\d{4}(?:-\d{4})?(?:,\s*\d{4}(?:-\d{4})?)*"
_NOTICE = rf"Copyright(?:\s+\(c\))?\s+({_YEARS}),?\s+([^\n]+)$"
_NEAR = 12  # common words from which a header is a variant of a known one
_HOLDER = 12  # maximum number of words of a copyright holder


class Header(NamedTuple):
    """The copyright notice and license header of a source file."""

    path: str
    location: Location
    """The first notice, or the first line without one."""
    holders: tuple[str, ...] = ()
    license: str | None = None
    """The SPDX identifier of the known header; ``None`` if there is none."""
    text: str = ""
    """The text after the last notice, in one line."""
    unreadable: str = ""
    """Why ament_copyright crashes on this file."""

    @property
    def is_known(self) -> bool:
        """Whether the linter accepts the file."""
        return bool(self.holders) and self.license is not None


@remembered
def headers(package: Package) -> list[Header]:
    """Return the headers of the source files that ament_copyright checks.

    These are C, C++, CMake and Python files except empty ones and the ``setup.py`` next to
    package.xml.
    """
    result: list[Header] = []
    for path in lintable(package):
        if os.path.splitext(path)[1] not in EXTENSIONS or path == "setup.py":
            continue
        header = _header(package, path) if path.endswith(".py") else _read(package, path)
        if header is not None:
            result.append(header)
    for path in broken_links(package):
        if os.path.splitext(path)[1] in EXTENSIONS:
            at = Location.start_of(path)
            result.append(Header(path, at, unreadable="broken symbolic link"))
    return result


@fact
def _header(package: Package, path: str) -> Header | None:
    return _read(package, path)


def _read(package: Package, path: str) -> Header | None:
    """Return the header of a source file; ``None`` if it is empty or cannot be read."""
    try:
        data = package.bytes_of(path)
    except LargeFileError:
        with suppress(ViewError):
            package.data(path)  # which reports it as too large
        return None
    except OSError:
        return None  # SC001, if a rule needs the file
    return read(path, data) if data else None


def read(path: str, data: bytes) -> Header:
    """Return the header of a source file that is not empty."""
    at = Location.start_of(path)
    try:
        text = data.decode("utf-8")
    except UnicodeDecodeError as error:
        line = data.count(b"\n", 0, error.start) + 1
        text = f"byte 0x{data[error.start]:02x} in line {line} is not UTF-8"
        return Header(path, at, unreadable=text)
    text = text.replace("\r\n", "\n").replace("\r", "\n")
    start = _behind_first_lines(text)
    if start is None:
        return Header(path, at, unreadable="the file ends after its first line")
    blocks = [_line_comments(text, start)]
    if distributions.target().fact("copyright.reads_block_comments"):
        blocks.append(_block_comment(text, start))
    for block in blocks:
        notices, rest = _notices(block)
        if notices:
            first = notices[0].split("\n", 1)[0]
            offset = max(text.find(first), 0)
            line = text.count("\n", 0, offset) + 1
            column = offset - text.rfind("\n", 0, offset)
            at = Location(path, line, column, line, column + len(first))
            holders = tuple(_holder_in(notice) for notice in notices)
            text = " ".join(rest.split())
            return Header(path, at, holders, identify(text), text)
    return Header(path, at)


def _behind_first_lines(text: str) -> int | None:
    """Return the offset after shebang, coding and empty lines; None if no text follows."""
    at = 0
    while True:
        begin = 1 if at == 0 and text[0] == "\ufeff" else at
        if begin >= len(text):
            return None
        end = _next_line(text, at)
        line = text[at:end]
        is_coding = "coding=" in line or "coding:" in line
        if text[begin] != "#" or not (is_coding or text.startswith("#!", begin)):
            break
        at = end
    while at < len(text) and _next_line(text, at) == at + 1:
        at += 1
    return at


def _next_line(text: str, at: int) -> int:
    end = text.find("\n", at)
    return len(text) if end < 0 else end + 1


def _line_comments(text: str, start: int) -> str:
    """Return the first block of line comments, wherever it is, without the comment marks."""
    mark = "\ufeff" if start == 0 and text[0] == "\ufeff" else ""
    match = re.compile(rf"^{mark}(#|///|//)", re.MULTILINE).search(text, start)
    if match is None:
        return ""
    token = match[1]
    end = _next_line(text, match.start(1))
    while text.startswith(token, end):
        end = _next_line(text, end)
    lines = text[match.start(1) : end].splitlines()
    return "\n".join(line[len(token) + 1 :] for line in lines)


def _block_comment(text: str, start: int) -> str:
    """Return the lines of the first block comment without their common prefix."""
    mark = "\ufeff" if start == 0 and text[0] == "\ufeff" else ""
    for opening, closing in (("/*", "*/"), ("<!--", "-->")):
        if text.find(opening, start) < 0:
            continue  # the usual case: the patterns below are slow
        first = re.compile(rf"^{mark}({re.escape(opening)})", re.MULTILINE).search(text, start)
        last = re.compile(rf"{re.escape(closing)}$", re.MULTILINE).search(text, start)
        if first is None or last is None:
            continue
        lines = text[first.start(1) : last.start()].splitlines()
        if len(lines) > 1:
            lines = lines[1:-1] or lines[1:]
        if len(lines) > 1:
            lines = _without_common_beginning(lines)
        return "\n".join(lines)
    return ""


def _without_common_beginning(lines: list[str]) -> list[str]:
    first, last = min(lines), max(lines)
    same = 0
    while same < len(first) and first[same] == last[same : same + 1]:
        same += 1
    return [line[same:] for line in lines]


def _notices(block: str) -> tuple[list[str], str]:
    """Return the copyright notices, and the text after the last one."""
    result: list[str] = []
    end = 0
    is_exact = distributions.target().fact("copyright.is_case_sensitive")
    flags = re.RegexFlag(0) if is_exact else re.IGNORECASE
    notice = re.compile(_NOTICE, re.MULTILINE | flags)
    for word in re.finditer("Copyright", block, flags):
        if word.start() < end or not _begins_line(block, word.start(), end):
            continue
        match = notice.match(block, word.start())
        if match:
            result.append(match[0])
            end = match.end()
    return result, block[end:]


def _begins_line(block: str, at: int, floor: int) -> bool:
    r"""Return whether only spaces, one other character or ``\copyright`` precede ``at``."""
    before = _skip_space_back(block, at, floor)
    if _is_near_start(block, before, at, floor):
        return True
    command = "\\copyright"
    at = before - len(command)
    if at < floor or block[at:before].lower() != command:
        return False
    return _is_near_start(block, _skip_space_back(block, at, floor), at, floor)


def _is_near_start(block: str, before: int, at: int, floor: int) -> bool:
    """Return whether the spaces from ``before`` to ``at`` are at the first or second column."""
    if before == floor or "\n" in block[before:at]:
        return True
    return before - 1 == floor or block[before - 2] == "\n"


def _skip_space_back(block: str, at: int, floor: int) -> int:
    while at > floor and block[at - 1].isspace():
        at -= 1
    return at


def _holder_in(notice: str) -> str:
    # linear: whatever is left of the line matches
    match = re.fullmatch(_NOTICE, notice, re.IGNORECASE)
    return match[2].strip() if match else ""


# -- known texts


class KnownText(NamedTuple):
    """The text of a license, split at the placeholders for names."""

    license: str
    sections: tuple[str, ...]


def contributing(license_: str) -> str | None:
    """Return the CONTRIBUTING.md of a license, as written by `new`; ``None`` without one."""
    directory = os.path.join(content.built_in(), "templates", "_licenses")
    if license_ not in os.listdir(directory):  # the name is from the user, and may be a path
        return None
    path = os.path.join(directory, license_)
    try:
        with open(os.path.join(path, f"{CONTRIBUTING}.jinja"), encoding="utf-8") as file:
            return file.read()
    except OSError:
        return None


def _known_texts(kind: str) -> tuple[KnownText, ...]:
    """Return the known texts of a kind for the linter of the target."""
    unknown = distributions.target().fact("copyright.unknown_licenses")
    return tuple(item for item in known_texts()[kind] if item.license not in unknown)


@lru_cache(maxsize=1)
def known_texts() -> dict[str, list[KnownText]]:
    """Return the known texts of ament_copyright by kind: ``header``, or the name of a file."""
    result: dict[str, list[KnownText]] = {}
    with open(_LICENSES, encoding="utf-8") as file:
        for line in file:
            kind, license_, *sections = line.rstrip("\n").split("\t")
            result.setdefault(kind, []).append(KnownText(license_, tuple(sections)))
    return result


def identify(text: str) -> str | None:
    """Return the SPDX identifier of the license header in a normalized text."""
    return _identified(text, _known_texts("header"))


@lru_cache(maxsize=256)
def _identified(text: str, texts: tuple[KnownText, ...]) -> str | None:
    for known_text in texts:
        if _in_order(text, known_text.sections):
            return known_text.license
    return None


def _in_order(text: str, sections: tuple[str, ...]) -> bool:
    last = -1
    for section in sections:
        at = text.find(section)
        if at <= last:
            return False
        last = at
    return True


def departure(text: str) -> tuple[str, str, str] | None:
    """Return the license closest to an unknown header, and the difference.

    Returns:
        The SPDX identifier, the expected and the actual words; ``None`` when no known header is
        similar.
    """
    best: tuple[int, str, str, str] | None = None
    words = text.split()
    for known_text in _known_texts("header"):
        same, expected, given = _compare(words, [part.split() for part in known_text.sections])
        enough = min(_NEAR, sum(map(len, (part.split() for part in known_text.sections))) // 2)
        if same >= enough and (best is None or same > best[0]):
            best = same, known_text.license, " ".join(expected[:4]), " ".join(given[:4])
    return best[1:] if best else None


def _compare(words: list[str], sections: list[list[str]]) -> tuple[int, list[str], list[str]]:
    """Return the number of equal words, then the expected and the actual words after them."""
    same = at = 0
    for number, section in enumerate(sections):
        reach = at + _HOLDER if number else len(words)
        starts = (i for i in range(at, min(reach, len(words))) if words[i : i + 3] == section[:3])
        at = next(starts, at)
        for expected, word in enumerate(section):
            if words[at : at + 1] != [word]:
                following = [w for part in sections[number + 1 :] for w in ("<holder>", *part)]
                return same, section[expected:] + following, words[at:]
            same += 1
            at += 1
    return same, [], words[at:]


def identify_file(name: str, data: bytes) -> str | None:
    """Return the SPDX identifier of a LICENSE or CONTRIBUTING.md, ``None`` if it is unknown."""
    text = " ".join(data.decode("utf-8", "replace").split())
    for known_text in _known_texts(name):
        last = -1
        for mark in known_text.sections:
            at = _find_marked(text, mark)
            if at <= last:
                break
            last = at
        else:
            return known_text.license
    return None


def _find_marked(text: str, mark: str) -> int:
    """Find a long text, stored only as length, digest and first characters."""
    from hashlib import sha256

    length, digest, beginning = mark.split(" ", 2)
    at = text.find(beginning)
    while at >= 0:
        part = text[at : at + int(length)]
        if sha256(part.encode()).hexdigest()[: len(digest)] == digest:
            return at
        at = text.find(beginning, at + 1)
    return -1
