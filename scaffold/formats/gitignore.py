"""Patterns of ``.gitignore`` files, as gitignore(5) defines them."""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import cached_property

from scaffold import lazy_re
from scaffold.record import NamedTuple


class _Pattern(NamedTuple):
    regex: str
    """The regular expression for paths relative to the directory of the file."""
    is_taken_back: bool
    is_for_directories: bool


class IgnoreFile:
    """The patterns of one file.

    Args:
        text: The content of the file.
    """

    def __init__(self, text: str) -> None:
        self._text = text

    def decides(self, path: str, *, is_directory: bool) -> bool | None:
        """Return whether a path is ignored, ``None`` if no pattern matches.

        Parent directories are not considered, although their content is ignored as well.

        Args:
            path: The path relative to the directory of the file.
            is_directory: Whether the path is a directory.
        """
        _, for_directories, for_files = self._compiled
        matched = (for_directories if is_directory else for_files).fullmatch(path)
        if matched is None:
            return None
        return not self._compiled[0][int(str(matched.lastgroup)[1:])].is_taken_back

    @cached_property
    def _compiled(self) -> tuple[list[_Pattern], re.Pattern[str], re.Pattern[str]]:
        patterns = [*_read(self._text)]
        # The last matching pattern decides.
        groups = [(f"(?P<p{at}>{pattern.regex})", pattern) for at, pattern in enumerate(patterns)][
            ::-1
        ]
        files = [group for group, pattern in groups if not pattern.is_for_directories]
        never = ["(?!)"]
        return (
            patterns,
            re.compile("|".join([group for group, _ in groups] or never), re.DOTALL),
            re.compile("|".join(files or never), re.DOTALL),
        )


def _read(text: str) -> Iterator[_Pattern]:
    for line in text.splitlines():
        pattern = line.rstrip()
        if pattern.endswith("\\"):
            pattern = line[: len(pattern) + 1]
        if not pattern or pattern.startswith("#"):
            continue
        is_taken_back = pattern.startswith("!")
        pattern = pattern[is_taken_back:]
        is_for_directories = pattern.endswith("/")
        pattern = pattern.rstrip("/")
        start = "" if "/" in pattern else "(?:.*/)?"
        regex = start + _translate(pattern.removeprefix("/"))
        try:
            re.compile(regex)
        except re.error:
            continue
        yield _Pattern(regex, is_taken_back, is_for_directories)


_PIECES = lazy_re.compile(
    r"(?P<any_start>(?:^|(?<=/))\*\*/)|(?P<any_end>(?<=/)\*\*$)|(?P<star>\*+)|(?P<one>\?)"
    r"|\[(?P<not>[!^]?)(?P<set>\]?(?:\\.|[^\]\\]){0,99})\]|\\(?P<escaped>.)|(?P<plain>.)",
    re.DOTALL,
)


def _translate(pattern: str) -> str:
    """Return a pattern as a regular expression."""
    parts: list[str] = []
    for piece in _PIECES.finditer(pattern):
        match piece.lastgroup:
            case "any_start":
                parts.append("(?:.*/)?")
            case "any_end":
                parts.append(".+")
            case "star":
                parts.append("[^/]*")
            case "one":
                parts.append("[^/]")
            case "set":
                inside = piece["set"].replace("[", "\\[").replace("]", "\\]")
                parts.append(f"(?!/)[{'^' if piece['not'] else ''}{inside}]")
            case _:
                parts.append(re.escape(piece["escaped"] or piece["plain"]))
    return "".join(parts)
