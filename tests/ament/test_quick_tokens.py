"""The fast tokenizer returns the same tokens as that of Python, or rejects the file."""

from __future__ import annotations

import io
import sys
import tokenize
from pathlib import Path
from random import Random

import pytest

from scaffold.ament.python_text.quick_tokens import Token, read

pytestmark = pytest.mark.skipif(
    sys.version_info >= (3, 12), reason="Python has a fast tokenizer, and another for f-strings"
)

TOP = Path(__file__).parents[2]
FILES = [*sorted((TOP / "scaffold" / "ament").rglob("*.py")), Path(__file__)]
PIECES = (
    "",
    "'",
    '"',
    '"""',
    "\\",
    "\\\n",
    "(",
    ")",
    "\t",
    "  ",
    "#",
    "é",
    "²",
    ".5",
    "0x",
    "b'",
    "\f",
    "!",
    "\n",
)


def lines_of(text: str) -> list[str]:
    """Return lines as linters count them; str.splitlines also splits at form feeds."""
    return io.StringIO(text).readlines()


def quick(text: str) -> list[Token] | None:
    return read(text, lines_of(text))


def slow(text: str) -> list[Token] | None:
    feed = iter([*lines_of(text), ""]).__next__
    try:
        return [*tokenize.generate_tokens(feed)]
    except (tokenize.TokenError, SyntaxError):
        return None


@pytest.mark.parametrize(
    "text",
    [
        "x = 1\n",
        "",
        "\n",
        "  \n",
        "# comment\n",
        "if x:\n    # comment\n    y = '''a\nb''' + 'c'\nz = 1\n",
        "x = (1,\n\n     # comment\n     2)\n",
        "x = 1 + \\\n    2\n",
        "x = 'a\\\nb' + 'c'\n",
        "if x:\n  if y:\n    z\nw\n",
        "x = .5e3j + 0xFF + 1_000 + 1. + 1..real\n",
        "rb'a' Rb\"b\" f'{x!r:>{y}}' u'c' bytes'x'\n",
        "x: int = y[...] if (z := 1) else ~w\n",
        "def f(a, /, *, b) -> None: return a @ b ** 2 // 3 << 4 != 5\n",
        "naïve = café\n",
    ],
)
def test_tokens_equal_those_of_python(text: str) -> None:
    tokens = quick(text)
    assert tokens is None or tokens == slow(text)
    assert tokens is not None or text in {"", "  \n"} or "bytes'" in text


@pytest.mark.parametrize(
    "text", ["if x:\n\ty\n", "x = 1", "x = $\n", "x = (\n", "x = 'a\n", "if x:\n  y\n z\n"]
)
def test_unusual_code_is_left_to_python(text: str) -> None:
    assert quick(text) is None


@pytest.mark.parametrize("path", FILES, ids=lambda path: str(path.relative_to(TOP)))
def test_tokens_of_files_and_mutants(path: Path) -> None:
    text = path.read_text("utf-8")
    assert quick(text) == slow(text)
    random = Random(path.name)  # noqa: S311  no secrets
    for _ in range(5):
        at = random.randrange(len(text))
        damaged = text[:at] + random.choice(PIECES) + text[at + random.randrange(2) :]
        tokens = quick(damaged)
        assert tokens is None or tokens == slow(damaged)
