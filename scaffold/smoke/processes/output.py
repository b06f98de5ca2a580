"""Extracts the relevant lines from the output of a build or an executable."""

from __future__ import annotations

import os
import re
from collections.abc import Iterable, Iterator
from itertools import pairwise
from pathlib import Path

SHOWN_LINES = 24
"""Lines of one problem that are shown at most."""
READ_BYTES = 1_000_000

TRACEBACK = "Traceback (most recent call last):"

_FRAMES = 2
"""Frames of a traceback that are shown: where it happened and who called."""
_LIBRARY = re.compile(
    r"/rclpy/|/colcon_|/setuptools/|<frozen |load_entry_point|"
    r"/lib/python3\.\d+/(?!(?:site|dist)-packages/)"
)
"""Frames outside the user's code; the second to last is in the scripts of setuptools."""
PASSED_ON = "CalledProcessError"
"""An exception that reports the failure of another program, which printed the reason itself."""
_CMAKE_ERROR = re.compile(r"CMake Error")
_CMAKE_WARNING = re.compile(r"CMake (?:Deprecation )?Warning")
_ERROR_LINE = re.compile(r"^\S.*\b(?:fatal )?error(?: in [\w.-]+ setup command)?: |^error: ")
_WARNING_LINE = re.compile(r"\bwarning: |(?<=\w)Warning: ")
_COMPLAINT = re.compile(
    r"^\[[\d.]+s\] (?:WARNING|ERROR):[\w.]+:"
    r"(?P<text>.*(?:\n(?!\[|---|[A-Z][a-z]+ (?:>>>|<<<)|\s).+)*)",
    re.MULTILINE,
)
"""What colcon itself reports."""
_NAMED_ERROR = re.compile(r"^[\w.]*(?:Error|Exception)\b.*")
_USAGE = re.compile(r"^[ \t]*usage:.*", re.IGNORECASE | re.MULTILINE)
_REFUSAL = re.compile(r"^(?:.*: )?error: (?P<reason>.*)", re.IGNORECASE | re.MULTILINE)
"""What argparse, click and their like print, and what they then say."""
_IS_LACK = re.compile(r"\brequired\b|\bmissing\b|\btoo few\b|\bexpect", re.IGNORECASE)
_TOO_SHORT = re.compile(r"IndexError: |ValueError: not enough values to unpack")
_ARGUMENTS = re.compile(r"\bargv\b|\barg\w*\[")
"""In the line of a program that reads its arguments by their number."""
_OWN_DOING = "byte-compiling is disabled"
"""A message of setuptools, because the build must not write into the sources."""
_ESCAPE = re.compile(r"\x1b\[[0-9;?]*[A-Za-z]")


def read(path: Path, start: int = 0) -> str:
    """Return what was written to a file, without terminal colors; empty if there is none.

    Args:
        path: The file; of a large one, the end is read.
        start: Bytes to skip at its beginning.
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
    """Return the bytes of a file; none of one that a program has removed with its directory."""
    try:
        return path.stat().st_size
    except OSError:
        return 0


def traceback(text: str) -> str | None:
    """Return the last Python traceback that tells a cause.

    What Python itself calls ignored is none, such as a destructor of rclpy that a signal came upon
    while its object was half made.
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
    """Return the line of a traceback with the exception."""
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
    """Return lines with the names of installed files as the sources have them."""
    place = rf"{re.escape(str(install))}/(?:[^/\"]+/)?lib/(?:python[\d.]+/[a-z]+-packages/)?"
    return [re.sub(place, "", line) for line in lines]


def tail(text: str, count: int = 10) -> list[str]:
    """Return the last lines that are not empty."""
    return [line for line in text.splitlines() if line.strip()][-count:]


def errors(text: str) -> list[str]:
    """Return the lines of a build's output that tell why it failed."""
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
    """Return the exception in the last line, as a syntax error has it without a traceback."""
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
    """Yield the messages of CMake: a head line and what is indented below it."""
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
