"""The paths that a pattern of glob or pathlib matches."""

from __future__ import annotations

import posixpath
import re
from collections.abc import Iterable

from scaffold.model.python.evaluation.values import Glob


def matches(pattern: Glob, files: Iterable[str]) -> list[str]:
    """Return the files that ``glob.glob`` would find next to setup.py."""
    expression = _expression(posixpath.normpath(pattern.pattern), recursive=pattern.recursive)
    return [path for path in files if re.fullmatch(expression, path)]


def _expression(pattern: str, *, recursive: bool) -> str:
    """Translate a glob pattern; ``*`` does not match a leading dot or a slash."""
    out = ""
    at = 0
    while at < len(pattern):
        rest = pattern[at:]
        if recursive and re.match(r"\*\*(/|$)", rest):
            out += r"(?:[^./][^/]*/)*" if rest.startswith("**/") else r"(?:[^/]+/)*[^/]+"
            at += 3
        elif rest[0] == "*":
            start = at == 0 or pattern[at - 1] == "/"
            out += r"(?!\.)[^/]*" if start else r"[^/]*"
            at += 1
        elif rest[0] == "?":
            out += r"[^/]"
            at += 1
        elif (group := re.match(r"\[(!?)([^\]]+)\]", rest)) is not None:
            inner = group[2].replace("\\", r"\\")
            out += f"[{'^' if group[1] else ''}{inner}]"
            at += len(group[0])
        else:
            out += re.escape(rest[0])
            at += 1
    return out
