"""Where a statement begins, as far as that is plain from the lines around it."""

from __future__ import annotations

import re

_FIRST = re.compile(r"[ \t]*([^\W\d]\w*)")
_BLOCKS = frozenset({"if", "for", "with"})
_INSIDE = frozenset(
    {"elif", "else", "except", "finally", "case", "while", "and", "or", "in", "is", "not"}
    | {"def", "class", "async", "lambda", "import", "from"}
)
"""Words that begin a line before which no other can be put."""
_SOMETIMES = re.compile(r"\b(?:lambda|for|if|else|and|or)\b|:=")
"""Matches what makes a call happen elsewhere, or only sometimes."""
_GOES_ON = re.compile(r"(?:[,(\[{\\=+\-*/%|&<>.]|\b(?:and|or|not|in|is|if|else|lambda|for))$")
_HEAD = re.compile(
    r"[ \t]*(?:(?:if|elif|else|for|while|with|try|except|finally|def|class|async|match|case)\b"
    r"|[)\]])"
)
_IN_F_STRING = re.compile(r"""\bf(['"])[^'"\n{}]*\{$""")
"""Matches what is before a call in a string with braces."""
_LINES_BACK = 6


def statement_around(text: str, start: int, end: int) -> int:
    """Return where the line of a call begins, if that line begins its statement; else -1."""
    line = text.rfind("\n", 0, start) + 1
    stop = text.find("\n", end)
    after = text[end : stop if stop >= 0 else len(text)]
    first = _FIRST.match(text, line)
    if first is None or first[1] in _INSIDE:
        return -1
    if first[1] in _BLOCKS and not after.rstrip().endswith(":"):
        return -1
    before = _IN_F_STRING.sub("", text[first.end() : start])
    if _SOMETIMES.search(before) or _SOMETIMES.search(after):
        return -1
    if before.count("'") % 2 or before.count('"') % 2 or not _is_closed(before, after):
        return -1
    return line if _ends_statement(text, line) else -1


def _is_closed(before: str, after: str) -> bool:
    """Tell whether the brackets that are open before a call are closed in its line."""
    opened = sum(map(before.count, "([{")) - sum(map(before.count, ")]}"))
    return opened <= 0 or opened <= sum(map(after.count, ")]}"))


def _ends_statement(text: str, line: int) -> bool:
    """Tell whether the code before a line does not go on in it."""
    for _ in range(_LINES_BACK):
        if not line:
            return True
        previous = text.rfind("\n", 0, line - 1) + 1
        code, comment, _ = text[previous : line - 1].partition("#")
        code = code.rstrip()
        if code:
            if comment and ("'" in code or '"' in code):
                return False
            if code.endswith(":"):
                return _HEAD.match(code) is not None
            return _GOES_ON.search(code) is None
        line = previous
    return False
