"""Logical lines found without tokenizing equal those of the tokenizer."""

from __future__ import annotations

import ast
import warnings
from pathlib import Path
from random import Random

import pytest

from scaffold.ament.python_text import quick_lines
from scaffold.ament.python_text.logical import LogicalLine, split
from scaffold.ament.python_text.text import PythonText
from scaffold.ament.python_text.tokenizer import read

TOP = Path(__file__).parents[2]
FILES = [*sorted((TOP / "scaffold" / "ament").rglob("*.py")), Path(__file__)]
STATEMENTS = (
    "",
    "\n",
    "x = 1\n",
    "x = 1",
    "# a comment",
    "if x:\n\n    # a comment\n    y = 1; z = 2  # and another\n\n# at the top\nelse: pass\n",
    "if x:\n\tif y:\n\t    z = '\t'\nx = 1\n",
    "def f(\n    a, b=('x', # one\n    'y'),\n\n):\n    return a + \\\n        b\n",
    "x = ''; y = \"\"; z = ''''''; a = \"\"\"\"'\"\"\"; b = '\\'' '\"' '#('\n",
    "x = '''a\n  b\n''' '''\n'''\ny = [\n'''\n''',\n]\n",
    "x = rb'\\'' + Rb'''\n''' + u'(' + bR'#'\n",
    "x = f'a{b}c {d!r:>{w}} {e:.2f} {{f}} {g[1:2]} {h=} {i[\"j\"]}' f\"{k['l']:{m}}\"\n",
    "x = f'''\n{\na}{b:\n}'''\n",
    "x = rf'\\{a}' + fr'{a}\\' + F'\\N{DASH}{b}'\n",
    'x = f"{\n1}"\n',
    'x = f"{d["a"]}" f"{d[\'b\']}"\n',
    'x = f"{f"{1}"}" f"{{{1}}}"\n',
    "x = f\"{'''}'''}\" f\"{\"#(\"}\"\n",
    "x = a if'b'else'{'\nf\n'{'\n",
    "x = 1 \\\n\ny = 2\n",
    "x = (1 if y else\\\n2)\n",
    "\\\nx = 1\n",
    "x = 1\n\f\ny = 2\n",
    "@a\n# b\n@c (\n)\nclass d: pass\n",
    "é = 'é'\nif é:\n    x = 'ß'\n",
)
PIECES = ("'", '"', '"""', "f'", "{", "}", "{{", "\\\n", "(", ")", "[", "]", "\t", "  ", "#", "\n")


def facts(line: LogicalLine) -> tuple[object, ...]:
    places = [line.position(offset) for offset in range(len(line.text) + 2)]
    first = line.first[:1] if line.first.endswith(("'", '"')) else line.first
    return (
        *(line.row, line.end_row, line.column, line.indent, line.blank_lines, line.is_comment),
        *(line.text, first, line.last, places, line.tokens),
    )


def differences(text: str) -> list[tuple[object, ...]]:
    """Return the differences; none for text that does not parse or needs the tokenizer."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            ast.parse(text)
        except (SyntaxError, ValueError):
            return []
    lines = PythonText("module.py", text).lines
    outline = quick_lines.read(text, lines, is_opened=True)
    if outline is None:
        return []
    expected = [facts(line) for line in split(read(lines), lines)]
    actual = [facts(line) for line in outline.lines]
    return [
        (item, two)
        for item, two in zip(
            [*expected, *[()] * (len(actual) - len(expected))],
            [*actual, *[()] * (len(expected) - len(actual))],
            strict=True,
        )
        if item != two
    ]


@pytest.mark.parametrize("text", STATEMENTS)
def test_logical_lines_of_statements(text: str) -> None:
    assert differences(text) == []


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.name)
def test_logical_lines_of_files_and_mutants(path: Path) -> None:
    text = path.read_text(encoding="utf-8")
    assert differences(text) == []
    chance = Random(path.name)  # noqa: S311  no secret
    for _ in range(5):
        at = chance.randrange(len(text))
        edited = text[:at] + chance.choice(PIECES) + text[at + chance.randrange(3) :]
        assert differences(edited) == []
