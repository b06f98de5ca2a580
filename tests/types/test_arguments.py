"""Inserted lines that tell the type checker the arguments of functions."""

from __future__ import annotations

import ast

import pytest

from scaffold.types.rewriting.arguments import with_arguments

CLASS = """\
class Talker:
    def __init__(self, rate):
        self.rate = rate

    def say(self, text, times=1):
        \"\"\"Say it.\"\"\"
        print(text * times)

    def run(self, name):
{}


Talker(rate())
"""


def added(source: str) -> list[str]:
    """Return the lines inserted into a file that is otherwise unchanged."""
    return changed(source, source)


def changed(source: str, expected: str) -> list[str]:
    """Return the lines inserted into a file that is otherwise as expected."""
    extended = with_arguments(source.encode())
    text = extended.data.decode()
    ast.parse(text)
    lines = text.split("\n")
    kept = [line for at, line in enumerate(lines, 1) if at not in extended.added]
    assert kept == expected.split("\n")
    for at, line in enumerate(lines, 1):
        original = extended.original_line(at)
        assert original == 0 or expected.split("\n")[original - 1] == line
    return [lines[at - 1].strip() for at in extended.added]


def inserted_for_call(call: str) -> list[str]:
    """Return the lines inserted for a call in ``run``, without those for the constructor."""
    source = CLASS.format("".join(f"        {line}\n" for line in call.split("\n")))
    return [line for line in added(source) if "rate" not in line]


def test_argument_is_stored_before_the_call_and_read_in_the_function() -> None:
    taken, kept = inserted_for_call("self.say(name)")
    name = taken.removeprefix("text = (").partition(")")[0]
    assert taken == f"text = ({name})[0]; times = ([1])[0]"
    assert kept == f"global {name}; {name} = [name]"


@pytest.mark.parametrize(
    "call",
    [
        "print(\n    self.say('x')\n)",
        "rows = {'a':\n    self.say('x')\n}",
        "rows = [\n    'if', self.say('x'),\n    'for',\n]\nfor row in rows:\n    print(row)",
    ],
)
def test_calls_in_statements_of_several_lines(call: str) -> None:
    assert inserted_for_call(call) == ["text = (['x'])[0]; times = ([1])[0]"]


def test_call_without_a_required_argument_is_no_source() -> None:
    assert inserted_for_call("self.say(times=2)") == []


@pytest.mark.parametrize(
    ("call", "taken"),
    [
        ("self.say('x')", "text = (['x'])[0]; times = ([1])[0]"),
        ("self.say(times=2, text='x')", "text = (['x'])[0]; times = ([2])[0]"),
        ("if self.say('x'):\n    pass", "text = (['x'])[0]; times = ([1])[0]"),
        ("x = print(self.say(\n    'x',\n    2,\n))", "text = (['x'])[0]; times = ([2])[0]"),
        ("# x,\nself.say('x')", "text = (['x'])[0]; times = ([1])[0]"),
    ],
)
def test_calls_at_the_start_of_their_statement(call: str, taken: str) -> None:
    assert sorted(inserted_for_call(call)[0].split("; ")) == sorted(taken.split("; "))


def test_calls_in_f_strings() -> None:
    assert inserted_for_call("print(f'it said {self.say(2):.2f}')") == [
        "text = ([2])[0]; times = ([1])[0]"
    ]


def test_different_calls_give_a_union() -> None:
    assert inserted_for_call("self.say('x')\nself.say(2)")[0].startswith(
        "text = (['x'] if _ros2_either else [2])[0]"
    )


@pytest.mark.parametrize(
    "call",
    [
        "rows = [\n    1 if name else self.say('x'),\n]",
        "rows = [self.say(row) for row in name]",
        "rows = [self.say(row)\n        for row in name]",
        "name and self.say('x')",
        "self.later = lambda text: self.say(text)",
        "if name:\n    pass\nelif self.say('x'):\n    pass",
        "while self.say('x'):\n    pass",
        "self.say(*name)",
        "self.say('x', 1, 2)",
        "self.say([self])",
        "self.say(text := 'x')",
        "print('{self.say(name)}')",
        "other.say('x')",
        "rows = name + \\\n    self.say('x')",
        "self.say(\n    'x',  # loud, and\n    2,\n)",
    ],
)
def test_unsupported_calls(call: str) -> None:
    assert inserted_for_call(call) == []


@pytest.mark.parametrize(
    "source",
    [
        "def f(a):\n    f(1)\n",
        "def f(a: 'str'):\n    pass\n\n\nf(1)\n",
        "@cached\ndef f(a):\n    pass\n\n\nf(1)\n",
        "def f(a=None):\n    pass\n\n\nf()\n",
        "def f(a):\n    pass\n\n\ndef f(a, b):\n    pass\n\n\nf(1)\n",
        "class A:\n    def f(self, a): ...\n\n\nclass B(C):\n    def g(self):\n        self.f(1)\n",
        "def f(a): return a\n\n\nf(1)\n",
        "def f(\n    a,  # first, b\n    c: int,\n):\n    pass\n\n\nf(1, 2)\n",
        "def f(a):\n    return a\r\n\n\nf(1)\n",
        "class A:\n    f = staticmethod(print)\n\n\nf(1)\n",
    ],
)
def test_unsupported_functions(source: str) -> None:
    assert added(source) == []


@pytest.mark.parametrize(
    "annotation",
    [": str", ": dict[str, int]", " : Callable[[A, A], a]", ": float = 1.0", ":int=2"],
)
def test_annotations_of_parameters_are_removed(annotation: str) -> None:
    source = "def f(a{}, *, b=0):\n    pass\n\n\nf('x', b=1)\n"
    two = "def f(no_a: A, a: A):\n    pass\n\n\nf(1, 2)\n"
    assert len(changed(two, two.replace(": A", "   "))) == 1
    type_, equals, default = annotation.partition("=")
    spaces = " " * len(type_.rstrip())
    bare = type_.replace(type_.rstrip(), spaces) + equals + default
    taken = changed(source.format(annotation), source.format(bare))
    assert taken == ["a = (['x'])[0]; b = ([1])[0]"]


def test_parameters_on_lines_of_their_own() -> None:
    source = CLASS.replace("(self, text, times=1)", "(\n        self,\n        text,\n    )")
    lines = added(source.replace(" * times", "").format("        self.say(name)\n"))
    taken, kept = [line for line in lines if "rate" not in line]
    name = taken.removeprefix("text = (").partition(")")[0]
    assert kept == f"global {name}; {name} = [name]"


def test_constructors_and_static_methods() -> None:
    assert added("class A:\n    def __init__(self, a):\n        pass\n\n\nA(1)\n") == [
        "a = ([1])[0]"
    ]
    source = (
        "class A:\n    @staticmethod\n    def f(a):\n        return a\n\n"
        "    def g(self):\n        self.f(1)\n"
    )
    assert added(source) == ["a = ([1])[0]"]


def test_usage_in_a_docstring_is_not_a_call() -> None:
    usage = 'name = param()\n        talker = Talker("map")\n'
    usage = f'    """Talks.\n\n    Usage:\n        {usage}    """\n'
    source = CLASS.format("        pass\n").replace("class Talker:\n", f"class Talker:\n{usage}")
    assert not [line for line in added(source) if '"map"' in line]
