"""Execution of functions: the value that Python returns, or UNKNOWN."""

from __future__ import annotations

import ast
import time

import pytest

from scaffold.model.python.evaluation.evaluator import Evaluator
from scaffold.model.python.evaluation.values import UNKNOWN
from scaffold.model.python.module import PythonModule
from scaffold.source import Source


def value(text: str) -> object:
    """Return what the last statement of a module assigns to ``x``."""
    module = PythonModule.parse(Source("a.py", text))
    last = module.tree.body[-1]
    assert isinstance(last, ast.Assign)
    return Evaluator(module).evaluate(last.value)


def function(body: str, arguments: str = "", parameters: str = "") -> str:
    """Return a module with a function of some lines, and a call of it."""
    indented = "".join(f"    {line}\n" for line in body.splitlines())
    return f"def f({parameters}):\n{indented}x = f({arguments})\n"


KNOWN = (
    function("def g():\n    nonlocal y\n    y = 2\ny = 1\ng()\nreturn y"),
    function("global y\ny = 1\nreturn y"),
    function("a = []\nfor i in range(3):\n    a.append(f'joint{i}')\nreturn a"),
    function("a = 1\na += 2\na = a * 2\nreturn a"),
    function("a = [1]\nb = a\nb.append(2)\nb += [3]\nreturn a"),
    function("for n in names:\n    if n == 'b':\n        return n", "['a', 'b']", "names"),
    function(
        "out = []\nfor n in names:\n    if n == 'b':\n        continue\n    if n == 'd':\n"
        "        break\n    out.append(n)\nelse:\n    out = []\nreturn out",
        "['a', 'b', 'c', 'd', 'e']",
        "names",
    ),
    function(
        "d = {}\nfor n in names:\n    if n[0] in d.keys():\n        d[n[0]].append(n)\n"
        "    else:\n        d[n[0]] = [n]\nreturn [(k, v) for k, v in d.items()]",
        "'ab', 'ac', 'bc'",
        "*names",
    ),
    function(
        "d = {}\nfor n in names:\n    d.setdefault(n[0], []).append(n)\nd['z'] = []\n"
        "return list(d.items())",
        "['ab', 'ac']",
        "names",
    ),
    function(
        "for n in names:\n    yield n, [n + '.py']\nyield from [1, 2]", "('a',)", "names"
    ).replace("x = f(('a',))", "x = list(f(('a',)))"),
    function("def g(z):\n    a.append(z + b)\na = []\nb = 'q'\ng('p')\nreturn a"),
    function("a, *b = 'x', 'y'\nreturn a").replace("a, *b", "a, b"),
    function("a = [1, 2, 3]\na.remove(2)\na.insert(0, 0)\na.pop()\na[0] = 9\nreturn a"),
    function("if unknown_ever:\n    c = 1\nreturn 'a'", "False", "unknown_ever"),
    function("return {k: [v] for k, v in zip(['a'], ['b'])}"),
    function(
        "return [a + b for a in 'p', for b in ('q', 'r') if b != 'q']".replace("'p',", "['p']")
    ),
    function("return sum([[i] for i in range(3)], [])"),
    function("with open(__file__):\n    a = 1\nreturn 1").replace(
        "open(__file__)", "memoryview(b'')"
    ),
    function("g(a)\nreturn a", "[1]", "a").replace(
        "def f", "def g(a):\n    a.append(2)\n\n\ndef f"
    ),
    function(
        "out = []\nfor i, n in enumerate(names):\n    if n.endswith(('.py', '.xml')):\n"
        "        out.append((i, n))\nreturn out",
        "['a.py', 'b.yaml']",
        "names",
    ),
    "names = ['a']\n"
    + function("return [n for n in names]", "", "").replace(
        "x = f()", "names.append('b')\nx = f()"
    ),
)


@pytest.mark.parametrize("text", KNOWN)
def test_value_is_that_of_python(text: str) -> None:
    names: dict[str, object] = {"__file__": __file__}
    exec(text, names)  # noqa: S102  the texts above
    assert value(text) == names["x"]


UNKNOWN_VALUES = (
    function("if a:\n    return 1\nreturn 2", "input()", "a"),
    function("for n in a:\n    return n\nreturn 2", "input()", "a"),
    function("while True:\n    return 1"),
    function("try:\n    return 1\nfinally:\n    pass"),
    function("raise ValueError"),
    function("return f()"),
    function("b = 1\nif a:\n    b = 2\nreturn b", "input()", "a"),
    function("return b"),
    function("b = []\nb[0] = 1\nreturn len(b)"),
    "@wrapped\n" + function("return 1"),
)


@pytest.mark.parametrize("text", UNKNOWN_VALUES)
def test_unknown_values(text: str) -> None:
    assert value(text) is UNKNOWN


@pytest.mark.parametrize(
    "body",
    [
        "b = [1]\nshuffle(b)\nreturn b",
        "b = [1]\nif a:\n    b.append(2)\nreturn b",
        "b = [1]\nfor n in a:\n    b.append(n)\nreturn b",
        "b = [1]\nc = b\nc.extend(a)\nreturn b",
        "b = {'k': []}\nb['k'].extend(a)\nreturn b['k']",
        "b = [1]\ndef g():\n    while a:\n        b.append(2)\ng()\nreturn b",
    ],
)
def test_changed_lists_are_not_known(body: str) -> None:
    result = value(function(body, "input()", "a"))
    assert result is UNKNOWN or (isinstance(result, list) and UNKNOWN in result)


def test_a_list_that_a_function_is_given_to_change() -> None:
    text = "def add(items):\n    items.append(2)\n\n\na = [1]\nadd(a)\nx = a\n"
    assert value(text) is UNKNOWN


def test_a_call_changes_no_value_that_is_kept() -> None:
    text = "def f(items):\n    items.append(2)\n    return items\n\n\nx = f([1])\n"
    module = PythonModule.parse(Source("a.py", text))
    last = module.tree.body[-1]
    assert isinstance(last, ast.Assign)
    evaluator = Evaluator(module)
    assert [evaluator.evaluate(last.value) for _ in range(2)] == [[1, 2], [1, 2]]


@pytest.mark.parametrize(
    "body",
    [
        "a = []\n"
        + "".join(f"{' ' * depth}for i{depth} in range(10000):\n" for depth in range(15))
        + " " * 15
        + "a.append(1)\nreturn a",
        "a = [1]\nfor i in range(10000):\n    a.extend(a)\nreturn len(a)",
        "a = []\nfor i in range(10000):\n    a = [a, a]\nreturn a == a",
        "a = 'x'\nfor i in range(10000):\n    a += a\nreturn a",
        "return [1 for a in range(10000) for b in range(10000) for c in range(10000) if False]",
        "a = [1]\nfor i in a:\n    a.append(i)\nreturn f(a)",
    ],
)
def test_work_is_bounded(body: str) -> None:
    start = time.process_time()
    value(function(body))
    assert time.process_time() - start < 5
