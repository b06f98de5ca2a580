"""Extracts the relevant lines from the output of a build or an executable."""

from __future__ import annotations

import os
import re
from collections.abc import Iterable, Iterator
from itertools import pairwise
from pathlib import Path

from scaffold import lazy_re

SHOWN_LINES = 24
"""The maximum number of lines shown for a problem."""
READ_BYTES = 1_000_000

TRACEBACK = "Traceback (most recent call last):"

_FRAMES = 2
"""The number of traceback frames shown: the place of the error and its caller."""
_LIBRARY = lazy_re.compile(
    r"/rclpy/|/colcon_|/setuptools/|<frozen |load_entry_point|"
    r"/lib/python3\.\d+/(?!(?:site|dist)-packages/)"
)
"""Paths of frames outside the user's code; the second to last is that of setuptools scripts."""
PASSED_ON = "CalledProcessError"
"""An exception that reports the failure of another program, which printed the reason itself."""
_CMAKE_ERROR = lazy_re.compile(r"CMake Error")
_CMAKE_WARNING = lazy_re.compile(r"CMake (?:Deprecation )?Warning")
_ERROR_LINE = lazy_re.compile(r"^\S.*\b(?:fatal )?error(?: in [\w.-]+ setup command)?: |^error: ")
_WARNING_LINE = lazy_re.compile(r"\bwarning: |(?<=\w)Warning: ")
_COMPLAINT = lazy_re.compile(
    r"^\[[\d.]+s\] (?:WARNING|ERROR):[\w.]+:"
    r"(?P<text>.*(?:\n(?!\[|---|[A-Z][a-z]+ (?:>>>|<<<)|\s).+)*)",
    re.MULTILINE,
)
"""A message of colcon itself."""
_NAMED_ERROR = lazy_re.compile(r"^[\w.]*(?:Error|Exception)\b.*")
_USAGE = lazy_re.compile(r"^[ \t]*usage:.*", re.IGNORECASE | re.MULTILINE)
_REFUSAL = lazy_re.compile(r"^(?:.*: )?error: (?P<reason>.*)", re.IGNORECASE | re.MULTILINE)
"""The usage text of argparse, click and the like, with the error message."""
_IS_LACK = lazy_re.compile(r"\brequired\b|\bmissing\b|\btoo few\b|\bexpect", re.IGNORECASE)
_TOO_SHORT = lazy_re.compile(r"IndexError: |ValueError: not enough values to unpack")
_ARGUMENTS = lazy_re.compile(r"\bargv\b|\barg\w*\[")
"""A source line of a program that reads arguments by index."""
_OWN_DOING = "byte-compiling is disabled"
"""A message of setuptools caused by our own settings: the build must not write into the sources."""
_ESCAPE = lazy_re.compile(r"\x1b\[[0-9;?]*[A-Za-z]")


def read(path: Path, start: int = 0) -> str:
    """Return the content of a file without terminal colors; empty if there is no file.

    Args:
        path: The file; of a large one, the end is read.
        start: The number of bytes to skip.
    """
    try:
        with path.open("rb") as file:
            file.seek(0, os.SEEK_END)
            file.seek(max(start, file.tell() - READ_BYTES))
            data = file.read()
    except OSError:
        return ""
    return _ESCAPE.sub("", data.decode("utf-8", "replace")).replace("\r", "\n")


def size(path: Path) -> int:
    """Return the size of a file; 0 if a program has removed it."""
    try:
        return path.stat().st_size
    except OSError:
        return 0


def traceback(text: str) -> str | None:
    """Return the last Python traceback with a cause.

    Exceptions ignored by Python do not count, as in a destructor of rclpy called by a signal
    during construction.
    """
    parts = text.split(TRACEBACK)
    for before, part in reversed([*pairwise(parts)]):
        if before.rstrip().rpartition("\n")[2].startswith("Exception ignored in"):
            continue
        lines = part.splitlines()
        end = 1
        while end < len(lines) and (not lines[end].strip() or lines[end][0].isspace()):
            end += 1
        result = "\n".join((TRACEBACK, *lines[1 : end + 1])).rstrip()
        if PASSED_ON not in exception(result):
            return result
    return None


def exception(trace: str) -> str:
    """Return the exception line of a traceback."""
    return trace.rpartition("\n")[2].strip()


def short(trace: str) -> list[str]:
    """Return the header of a traceback, its last frames in code of the user, and the exception."""
    frames: list[list[str]] = []
    ending: list[str] = []
    for line in trace.splitlines()[1:]:
        if line.startswith('  File "'):
            frames.append([line])
        elif line.startswith("    ") and frames:
            frames[-1].append(line)
        else:
            ending.append(line)
    own = [frame for frame in frames if not _LIBRARY.search("".join(frame))] or frames
    shown = own[-_FRAMES:]
    gap = ["  ..."] if len(shown) < len(frames) else []
    lines = [line for frame in shown for line in frame]
    return _limited([TRACEBACK, *gap, *lines, *ending])


def relative(lines: Iterable[str], install: Path) -> list[str]:
    """Return lines with installed paths replaced by those of the sources."""
    place = rf"{re.escape(str(install))}/(?:[^/\"]+/)?lib/(?:python[\d.]+/[a-z]+-packages/)?"
    return [re.sub(place, "", line) for line in lines]


def tail(text: str, count: int = 10) -> list[str]:
    """Return the last lines that are not empty."""
    return [line for line in text.splitlines() if line.strip()][-count:]


def errors(text: str) -> list[str]:
    """Return the lines of the output of a build that explain its failure."""
    blocks = [line for block in _cmake_blocks(text, _CMAKE_ERROR) for line in block]
    trace = traceback(text)
    if trace is not None:
        blocks += short(trace)
    if not blocks:
        blocks = [line for line in text.splitlines() if _ERROR_LINE.search(line)]
    return _limited(blocks or tail(text))


def warnings(text: str) -> list[str]:
    """Return the warnings of a build's output."""
    lines = [line for block in _cmake_blocks(text, _CMAKE_WARNING) for line in block]
    in_blocks = set(lines)
    lines += [
        line
        for line in text.splitlines()
        if _WARNING_LINE.search(line) and _OWN_DOING not in line and line not in in_blocks
    ]
    return _limited(lines)


def complaints(text: str, directory: str) -> list[str]:
    """Return the errors of colcon itself about the package in a directory."""
    result = [match["text"] for match in _COMPLAINT.finditer(text) if directory in match["text"]]
    return _limited([line for item in result for line in item.splitlines()])


def named_error(text: str) -> str | None:
    """Return the exception in the last line, as for a syntax error without a traceback."""
    last = "".join(tail(text, 1))
    return last if _NAMED_ERROR.match(last) else None


def missing_arguments(text: str) -> str | None:
    """Return the line in which a failed program reports missing arguments.

    Returns:
        ``None`` if that is not why.
    """
    trace = traceback(text)
    if trace is not None:
        code = [line for line in trace.splitlines() if line.startswith("    ")]
        last = [line for line in code if line.strip(" ^~")][-1:]
        is_lack = _TOO_SHORT.match(exception(trace)) and _ARGUMENTS.search("".join(last))
        return exception(trace) if is_lack else None
    usage = _USAGE.search(text)
    if usage is None:
        return None
    refusals = [match["reason"] for match in _REFUSAL.finditer(text, usage.end())]
    if not refusals:
        return usage[0].strip()
    return refusals[-1] if _IS_LACK.search(refusals[-1]) else None


def _cmake_blocks(text: str, start: re.Pattern[str]) -> Iterator[list[str]]:
    """Yield the messages of CMake: a first line with the indented lines below it."""
    block: list[str] = []
    for line in text.splitlines():
        if start.match(line):
            if block:
                yield block
            block = [line]
        elif block and (not line.strip() or line[0].isspace()):
            if line.strip():
                block.append(line)
        elif block:
            yield block
            block = []
    if block:
        yield block


def _limited(lines: list[str]) -> list[str]:
    if len(lines) <= SHOWN_LINES:
        return lines
    half = SHOWN_LINES // 2
    return [*lines[:half], "...", *lines[-half:]]
