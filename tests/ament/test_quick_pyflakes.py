"""The fast checker reports the same as pyflakes."""

from __future__ import annotations

import ast
from pathlib import Path
from random import Random

import pytest
from pyflakes.checker import Checker

from scaffold.ament.flake8.quick_pyflakes import QuickChecker

TOP = Path(__file__).parents[2]
FILES = [*sorted((TOP / "scaffold" / "ament").rglob("*.py")), Path(__file__)]
SOURCES = (
    "import os\nfrom __future__ import annotations\n",
    "'doc'\nfrom __future__ import division, nothing\n",
    "def f():\n    from __future__ import division\n",
    "from typing import cast as c, overload\nimport typing as t\nc('A', 1); t.cast('B', 1)\n",
    "from typing import *\nimport typing as t\nT = t.TypeVar('T', 'B', bound='C')\n",
    "import typing as t\nD = t.TypedDict('D', {'a': 'E'}); E = t.TypedDict('E', a='F')\n",
    "import typing as t\nN = t.NamedTuple('N', [('a', 'F')]); M = t.NamedTuple('M', a='I')\n",
    "'{} {a}'.format(1, b=2); '%s %s' % (1,); print >> 1; x = {'a': 1, 'a': 2}\n",
    "def f(a, a): print(b); b = 1; del a, c; global g; return locals()\n",
    "class A:\n    x = [y for y in z if (w := y)]\n    import os, os\n    def f(self): __class__\n",
    "try: pass\nexcept: pass\nexcept E as e: pass\nfor os in (): import os\nbreak\n",
    "from a import *\n__all__ = ['b', *c]\nmatch d:\n    case {'e': f, **g}: pass\n",
    "if (1, 2): assert (3, 4)\nx is 'y'; raise NotImplemented\nf'a'; a, *b, *c = d\n",
)


def is_same_as_pyflakes(text: str) -> bool:
    def messages(checker: Checker) -> list[tuple[str, int, int, str]]:
        return [
            (type(item).__name__, item.lineno, item.col, str(item)) for item in checker.messages
        ]

    ours = messages(QuickChecker(ast.parse(text), "module.py", {"given"}))
    theirs = Checker(ast.parse(text), "module.py", {"given"}, withDoctest=False)
    return ours == messages(theirs)


@pytest.mark.parametrize("text", SOURCES)
def test_findings_in_samples(text: str) -> None:
    assert is_same_as_pyflakes(text)


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.name)
def test_findings_in_files_and_mutants(path: Path) -> None:
    text = path.read_text(encoding="utf-8")
    assert is_same_as_pyflakes(text)
    tree = ast.parse(text)
    chance = Random(path.name)  # noqa: S311  no secret
    for node in chance.sample(tree.body, min(3, len(tree.body))):
        tree.body.remove(node)
    assert is_same_as_pyflakes(ast.unparse(tree))
