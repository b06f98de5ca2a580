"""Code blocks with placeholders that depend on their place, loops and local names."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from textwrap import dedent

COUNT = "@count"
"""Token for the number of messages so far; in a loop, each element has its own count."""
WAVE = "@wave"
"""Token for a sine that moves with the count."""
NOW = "@now"
"""Token for the time of the node's clock, as a message."""
WIDTH = 91
"""Maximum width of a line of a method, without its indentation."""
INDENT = "    "

COUNTER = "self.count"
"""The expression for a count where there is no other."""
_CLOCK = "self.get_clock().now().to_msg()"
_SINE = "math.sin({} / 10.0)"


def is_now(stamp: str) -> str:
    """Return an expression for a test that is true for a stamp of the last minute."""
    return f"abs(time.time() - {stamp}.sec) < 60"


class Block:
    """Statements of one block, including its loops."""

    def __init__(self, parent: Block | None = None, counter: str = COUNTER) -> None:
        self._parent = parent
        self._counter = counter
        self._items: list[str | tuple[str, Block]] = []
        self._locals: dict[str, str] = {}
        self._comment = ""
        self._uncounted = ""

    @property
    def is_loop(self) -> bool:
        """Whether the block is the body of a loop."""
        return self._parent is not None

    def add(self, line: str, comment: str = "") -> None:
        """Add a line; it may hold tokens."""
        if comment and comment == self._comment:
            comment = ""
        else:
            self._comment = comment
        self._items.append(f"{line}  # {comment}" if comment else line)

    def loop(self, head: str, uncounted: str) -> Block:
        """Add a loop and return its body, where ``count`` is the number of the element.

        Args:
            head: The line that starts the loop.
            uncounted: The same line for a body that does not use ``count``.
        """
        body = Block(self, "count")
        body._uncounted = uncounted
        self._items.append((head, body))
        return body

    @property
    def is_counting(self) -> bool:
        """Whether the count is used."""
        return any(COUNT in text or WAVE in text for text in self.texts())

    def embed(self, code: str, target: str) -> None:
        """Add the code of a recipe, with ``msg`` replaced by a target.

        A local name that is already taken is prefixed with the name of the target.
        """
        text = (
            # linear: spaces with two line ends among them match
            re.sub(r"\n\s*\n", "\n", dedent(code))
            .strip()
            .replace(COUNTER, COUNT)
            .replace(_CLOCK, NOW)
        )
        text = re.sub(r"(?<![.\w'/])msg\b", target, text).replace(_SINE.format(COUNT), WAVE)
        for name in re.findall(r"(?m)^([a-z]\w*) = ", text):
            value = re.search(rf"(?m)^{name} = (.*)$", text)
            if value is None:
                continue
            definition = self._placed(value[1])
            existing = self.local(name)
            if existing == definition:
                text = re.sub(rf"(?m)^{name} = .*\n", "", text, count=1)
            elif existing is not None:
                new = f"{target.rpartition('.')[2]}_{name}"
                text = re.sub(rf"(?<![.\w'/]){name}\b(?!=)", new, text)
                self._locals[new] = definition
            else:
                self._locals[name] = definition
        self._items.extend(text.splitlines())

    def _placed(self, text: str) -> str:
        """Return a text with its tokens filled in; the count may be that of a loop."""
        return text.replace(COUNT, self._counter)

    def local(self, name: str) -> str | None:
        """Return the definition of a local name here or in an outer block, if any."""
        if name in self._locals:
            return self._locals[name]
        return self._parent.local(name) if self._parent else None

    def define(self, name: str, value: str) -> str:
        """Define a local name, changed if it is taken; return it."""
        existing = self.local(name)
        while existing not in {None, value}:
            name += "_"
            existing = self.local(name)
        self._locals[name] = value
        self._items.append(f"{name} = {value}")
        return name

    @property
    def size(self) -> int:
        """The number of lines, without local names for tokens."""
        sizes = (1 if isinstance(item, str) else item[1].size for item in self._items)
        return sum(sizes)

    def lines(self) -> list[str]:
        """Return the lines of a method."""
        now = "".join(self.texts()).count(NOW) > 1
        clock = "now" if now else _CLOCK
        head = [f"now = {_CLOCK}"] if now else []
        lines = [*head, *self.indented(clock, WIDTH)]
        return [line if len(line) <= WIDTH else f"{line}  # noqa: E501" for line in lines]

    def texts(self) -> Iterator[str]:
        """Yield the lines with their tokens, those of loops too."""
        for item in self._items:
            if isinstance(item, str):
                yield item
            else:
                yield item[0]
                yield from item[1].texts()

    def indented(self, clock: str, width: int) -> Iterator[str]:
        """Yield the lines of one level and those of its loops.

        Args:
            clock: The expression for the time.
            width: Columns of a line.
        """
        sine = _SINE.format(self._counter)
        own = [item for item in self._items if isinstance(item, str)]
        if "".join(own).count(WAVE) > 1:
            name = "wave" if self.local("wave") is None else "swing"
            yield f"{name} = {sine}  # -1.0 to 1.0"
            sine = name
        for item in self._items:
            if not isinstance(item, str) and not item[1].size:
                continue
            text = item if isinstance(item, str) else item[1].head(item[0])
            text = text.replace(WAVE, sine).replace(NOW, clock).replace(COUNT, self._counter)
            yield from wrapped(text, width)
            if not isinstance(item, str):
                for line in item[1].indented(clock, width - len(INDENT)):
                    yield INDENT + line

    def head(self, counting: str) -> str:
        """Return the line that starts the loop of this body."""
        return counting if self.is_counting else self._uncounted


def wrapped(line: str, width: int) -> Iterator[str]:
    """Yield a line, split if it is too long: first its comment, then at commas."""
    if len(line) <= width:
        yield line
        return
    code, mark, comment = line.partition("  # ")
    margin = line[: len(line) - len(line.lstrip())]
    if mark:
        yield f"{margin}# {comment}"
    if len(code) <= width:
        yield code
        return
    if code.endswith(":"):
        yield code
        return
    start = _opening(code)
    if not 0 <= start < width:
        yield from _in_brackets(code, margin, width)
        return
    inside = code[start + 1 : -1]
    if not inside:
        yield from _in_brackets(code, margin, width)
        return
    parts = list(_split(inside, " for "))
    yield code[: start + 1]
    if len(parts) > 1:  # a comprehension
        yield from (margin + INDENT + part for part in parts)
    else:
        pieces = [piece + "," for piece in _split(inside, ",")]
        single = pieces[0].removesuffix(",") if len(pieces) == 1 else ""
        yield from _filled([single] if single else pieces, margin + INDENT, width)
    yield margin + code[-1]


def _opening(code: str) -> int:
    """Return the index of the bracket closed at the end of a line; -1 if there is none."""
    depth = 0
    for at in range(len(code) - 1, -1, -1):
        depth += (code[at] in ")]}") - (code[at] in "([{")
        if depth == 0:
            return at if at < len(code) - 1 else -1
    return -1


def _in_brackets(code: str, margin: str, width: int) -> Iterator[str]:
    """Yield an assignment with its value in parentheses on separate lines, if these fit."""
    target, equals, value = code.partition(" = ")
    pieces = [f"{margin}{INDENT}{piece}" for piece in _split(value, " + ", " - ", " * ")]
    lines = [f"{target} = (", *pieces, f"{margin})"]
    if not equals or max(map(len, lines)) > width:
        yield code
    else:
        yield from lines


def _split(text: str, *marks: str) -> Iterator[str]:
    """Yield the parts of a text between separators outside of brackets and quotes.

    A separator that is a word or an operator starts the next part.
    """
    depth, start, quote = 0, 0, ""
    for at, character in enumerate(text):
        if quote:
            quote = "" if character == quote else quote
        elif character in "'\"":
            quote = character
        else:
            depth += (character in "([{") - (character in ")]}")
        if depth == 0 and not quote and (mark := _mark_at(text, at, marks)):
            yield text[start:at].strip()
            start = at + (len(mark) if mark == "," else 1)
    yield text[start:].strip()


def _mark_at(text: str, at: int, marks: Iterable[str]) -> str:
    return next((mark for mark in marks if text.startswith(mark, at)), "")


def _filled(pieces: Iterable[str], margin: str, width: int) -> Iterator[str]:
    line = ""
    for piece in pieces:
        if line and len(margin) + len(line) + 1 + len(piece) > width:
            yield margin + line
            line = ""
        line = f"{line} {piece}".strip()
    yield margin + line
