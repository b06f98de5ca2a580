"""Static evaluation of expressions: certain values, or UNKNOWN."""

from __future__ import annotations

import ast

import pytest
from hypothesis import given
from hypothesis import strategies as st

from scaffold.model.python.evaluation.evaluator import Evaluator
from scaffold.model.python.evaluation.values import UNKNOWN, Glob, PathValue, is_known
from scaffold.model.python.module import PythonModule
from scaffold.source import NewerSyntaxError, ParseError, Source


def value(text: str) -> object:
    """Return what the last statement of a module assigns to ``x``."""
    module = PythonModule.parse(Source("a.py", text))
    last = module.tree.body[-1]
    assert isinstance(last, ast.Assign)
    return Evaluator(module).evaluate(last.value)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("x = 'a'", "a"),
        ("x = 1", 1),
        ("x = 1.5", 1.5),
        ("x = True", True),
        ("x = None", None),
        ("x = b'a'", b"a"),
        ("x = 'a' 'b'", "ab"),
        ("x = 'a' + 'b'", "ab"),
        ("x = 1 / 4", 0.25),
        ("x = 7 // 2 + 7 % 4", 6),
        ("x = -2", -2),
        ("x = not ''", True),
        ("x = 'a' * 3", "aaa"),
        ("x = ['a', 1]", ["a", 1]),
        ("x = ('a', 1)", ("a", 1)),
        ("x = {'a': 1, **{'b': 2}}", {"a": 1, "b": 2}),
        ("x = [*[1, 2], *(3,)]", [1, 2, 3]),
        ("x = [1] + [2]", [1, 2]),
        ("x = ['a', 'b'][1]", "b"),
        ("x = {'a': 'b'}['a']", "b"),
        ("x = {'a': 'b'}.get('a')", "b"),
        ("x = 'abc'[0]", "a"),
        ("x = 'a' if 1 == 1 else 'b'", "a"),
        ("x = 'a' if unknown else 'a'", "a"),
        ("x = '' or 'b'", "b"),
        ("x = 'a' and 'b'", "b"),
        ("x = len('abc')", 3),
        ("x = max(1, 2.5)", 2.5),
        ("x = float('1.5')", 1.5),
        ("x = str(1)", "1"),
        ("x = int(2.9)", 2),
        ("x = (y := 'a')", "a"),
    ],
)
def test_literals_and_operators(text: str, expected: object) -> None:
    result = value(text + "\n")
    assert result == expected
    assert type(result) is type(expected)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("p = 'a'\nx = f'share/{p}'", "share/a"),
        ("x = f'{1:03d}|{2.5:.2f}|{\"a\"!r}'", "001|2.50|'a'"),
        ("x = 'share/%s/%d' % ('a', 3)", "share/a/3"),
        ("x = '%s' % 'a'", "a"),
        ("x = '%(a)s' % {'a': 1}", "1"),
        ("x = '{}/{n}'.format('a', n=1)", "a/1"),
        ("x = '/'.join(['a', 'b'])", "a/b"),
        ("x = ' A '.strip().lower()", "a"),
        ("x = 'a.b'.replace('.', '/')", "a/b"),
        ("x = 'a b'.split()", ["a", "b"]),
        ("import os\nx = os.path.join('share', 'a', 'launch')", "share/a/launch"),
        ("from os.path import join\nx = join('share/', 'a')", "share/a"),
        ("import os\nx = os.path.join('a', '/b')", "/b"),
        ("import os\np = ['a', 'b']\nx = os.path.join(*p)", "a/b"),
        ("import os\nx = 'a' + os.sep + 'b'", "a/b"),
        ("from pathlib import Path\nx = str(Path('a') / 'b')", "a/b"),
        ("from pathlib import Path\nx = f\"{Path('a', 'b')}/c\"", "a/b/c"),
        ("from pathlib import Path\nx = Path('a').joinpath('b').as_posix()", "a/b"),
    ],
)
def test_strings_and_paths(text: str, expected: object) -> None:
    assert value(text + "\n") == expected


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("p = 'a'\nq = p\nx = q", "a"),
        ("p: str = 'a'\nx = p", "a"),
        ("p, q = 'a', 'b'\nx = q", "b"),
        ("p = q = 'a'\nx = q", "a"),
        ("if unknown:\n    p = 'a'\nelse:\n    p = 'a'\nx = p", "a"),
        ("p = ['a']\np.append('b')\np += ['c']\np.extend(['d'])\nx = p", ["a", "b", "c", "d"]),
        ("x = [i + '/a' for i in ['p', 'q']]", ["p/a", "q/a"]),
        ("x = [i for i in ['p', 'q'] if i != 'p']", ["q"]),
        ("x = ['/'.join((a, b)) for a in ['p'] for b in ['q']]", ["p/q"]),
        ("x = list(('a', 'b'))", ["a", "b"]),
    ],
)
def test_values_of_names(text: str, expected: object) -> None:
    assert value(text + "\n") == expected


def test_list_has_its_value_at_the_place_of_use() -> None:
    module = PythonModule.parse(Source("a.py", "p = ['a']\nx = p\np.append('b')\ny = p\n"))
    evaluator = Evaluator(module)
    result = {
        module.text(node.targets[0]): evaluator.evaluate(node.value)
        for node in module.walk(ast.Assign)
    }
    assert result == {"p": ["a"], "x": ["a"], "y": ["a", "b"]}


def test_local_names_of_functions() -> None:
    module = PythonModule.parse(
        Source("a.py", "p = 'a'\ndef f():\n    p = 'b'\n    x = p\ndef g():\n    y = p\n")
    )
    evaluator = Evaluator(module)
    result = {
        module.text(node.targets[0]): evaluator.evaluate(node.value)
        for node in module.walk(ast.Assign)
        if isinstance(node.value, ast.Name)
    }
    assert result == {"x": "b", "y": "a"}


@pytest.mark.parametrize(
    "text",
    [
        "x = unknown",
        "x = f()",
        "x = __file__",
        "x = ...",
        "p = 'a'\np = 'b'\nx = p",
        "p = 'a'\np += 'b'\nx = p",
        "for p in ['a']:\n    pass\nx = p",
        "p = 'a'\ndef f():\n    global p\n    p = 'b'\nx = p",
        "p = 'a'\ndel p\nx = p",
        "p = q\nq = p\nx = p",
        "p = 1\nif a:\n    p = True\nx = p",
        "p = []\nfor i in range(3):\n    p.append(i)\nx = p",
        "p = [1]\np.insert(0, 2)\nx = p",
        "p = {'a': 1}\np['b'] = 2\nx = p",
        "p = {'a': 1}\np.update(b=2)\nx = p",
        "import os\nx = os.environ['ROS_DISTRO']",
        "x = 'a' + 1",
        "x = 'a' % 'b'",
        "x = '%q' % 'b'",
        "x = '{0.real}'.format(1)",
        "x = '{}'.format()",
        "x = 1 / 0",
        "x = 2 ** 3",
        "x = ['a'][3]",
        "x = {'a': 1}['b']",
        "x = {unknown: 1}",
        "x = {**unknown}",
        "x = [*unknown]",
        "x = 'a' if unknown else 'b'",
        "x = unknown or 'a'",
        "x = int('a')",
        "x = lambda: 1",
        "from a import *\nx = str(1)",
        "def str(x): pass\nx = str(1)",
        "from os import path as p\nx = p",
    ],
)
def test_unknown_values(text: str) -> None:
    assert value(text + "\n") is UNKNOWN


@pytest.mark.parametrize(
    "text",
    [
        "x = 'a' * 10 ** 9",
        "x = 'a' * 1000000000",
        "x = '%1000000000d' % 3",
        "x = '{:1000000000}'.format(1)",
        "x = f'{1:1000000000}'",
        "x = 10 ** 10 ** 10",
        "x = 999999999999999999 * 999999999999999999",
        "a0 = 'a'\n" + "".join(f"a{n} = a{n - 1} + a{n - 1}\n" for n in range(1, 90)) + "x = a89",
        "a0 = [1]\n"
        + "".join(f"a{n} = a{n - 1} + [1] + a{n - 1}\n" for n in range(1, 40))
        + "x = a39",
        "".join(f"b{n} = {' + '.join(f'b{m}' for m in range(30))}\n" for n in range(30)) + "x = b3",
        "a0 = []\n"
        + "".join(f"a{n} = [*a{n - 1}, *a{n - 1}]\n" for n in range(1, 50))
        + "x = a49 + unknown",
    ],
)
def test_values_are_bounded(text: str) -> None:
    assert value(text + "\n") is UNKNOWN


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("from glob import glob\nx = glob('launch/*.py')", [Glob("launch/*.py")]),
        ("import glob\nx = glob.glob('a/**', recursive=True)", [Glob("a/**", recursive=True)]),
        ("from glob import glob\nx = ['a'] + sorted(glob('b/*'))", ["a", Glob("b/*")]),
        (
            (
                "import os\nfrom glob import glob\n"
                "x = [f for f in glob(os.path.join('a', '*')) if os.path.isfile(f)]"
            ),
            [Glob("a/*", filtered=True)],
        ),
        (
            "from pathlib import Path\nx = [str(p) for p in Path('launch').glob('*.py')]",
            [Glob("launch/*.py", recursive=True)],
        ),
    ],
)
def test_values_of_globs(text: str, expected: object) -> None:
    assert value(text + "\n") == expected


def test_values_computed_from_glob_matches_are_unknown() -> None:
    assert value("from glob import glob\nx = [f + 'a' for f in glob('b/*')]\n") is UNKNOWN
    assert value("from glob import glob\nx = glob('b/*')[0]\n") is UNKNOWN


def test_elements_have_locations() -> None:
    module = PythonModule.parse(
        Source("a.py", "p = ['a']\nif c:\n    p.append('b')\nx = ['z'] + p + unknown\n")
    )
    last = module.tree.body[-1]
    assert isinstance(last, ast.Assign)
    result = Evaluator(module).elements(last.value)
    assert not result.complete
    assert [
        (item.value, module.location(item.node).line, item.conditional) for item in result.items
    ] == [("z", 4, False), ("a", 1, False), ("b", 3, True)]


def test_is_known_with_nested_unknown() -> None:
    assert is_known(["a", ("b", {"c": 1}), PathValue("d")])
    assert not is_known(["a", (UNKNOWN,)])
    assert not is_known({"a": [Glob("*")]})


def test_unknown_is_falsy_and_has_a_repr() -> None:
    assert not UNKNOWN
    assert f"{UNKNOWN}" == "UNKNOWN"


EXPRESSIONS = st.recursive(
    st.sampled_from(["'a'", "1", "2.5", "p", "q", "None", "x", "'%s'", "'{}'", "-3", "[]", "{}"]),
    lambda inner: st.one_of(
        st.builds("({} {} {})".format, inner, st.sampled_from("+-*/%"), inner),
        st.builds("({} // {})".format, inner, inner),
        st.builds("[{}, *{}]".format, inner, inner),
        st.builds("{{{}: {}}}".format, inner, inner),
        st.builds("({}, {})".format, inner, inner),
        st.builds("{}[{}]".format, inner, inner),
        st.builds("[{} for p in {} if {}]".format, inner, inner, inner),
        st.builds("({} if {} else {})".format, inner, inner, inner),
        st.builds("({} == {})".format, inner, inner),
        st.builds(
            "{}({})".format,
            st.sampled_from(["str", "int", "float", "len", "list", "max", "Path", "glob", "join"]),
            inner,
        ),
        st.builds(
            "{}.{}({})".format,
            inner,
            st.sampled_from(["format", "join", "split", "strip", "get", "append", "glob"]),
            inner,
        ),
        st.builds("f'{{{}}}'".format, st.sampled_from(["p", "q!r", "p:>5", "q:.2f", "x:{p}"])),
    ),
    max_leaves=12,
)
PRELUDE = "from glob import glob\nfrom os.path import join\nfrom pathlib import Path\n"


@given(EXPRESSIONS, EXPRESSIONS, EXPRESSIONS)
def test_evaluator_never_raises(first: str, second: str, third: str) -> None:
    try:
        value(f"{PRELUDE}p = {first}\nq = {second}\nx = {third}\n")
    except (ParseError, NewerSyntaxError):
        return


PLAIN = st.recursive(
    st.sampled_from(["'a'", "'%s-%s'", "1", "2.5", "True", "'b c'", "0", "''"]),
    lambda inner: st.one_of(
        st.builds("({} {} {})".format, inner, st.sampled_from("+-*/%"), inner),
        st.builds("[{}, *[{}]]".format, inner, inner),
        st.builds("({}, {})".format, inner, inner),
        st.builds("({} if {} else {})".format, inner, inner, inner),
        st.builds("({} or {})".format, inner, inner),
        st.builds("({} == {})".format, inner, inner),
        st.builds("str({})".format, inner),
        st.builds("int({})".format, inner),
        st.builds("len({})".format, inner),
        st.builds("[p for p in [{}, {}] if p]".format, inner, inner),
        st.builds("'{{}}/{{}}'.format({}, {})".format, inner, inner),
    ),
    max_leaves=8,
)


@pytest.mark.filterwarnings("ignore::SyntaxWarning")
@given(PLAIN)
def test_known_values_equal_those_of_python(text: str) -> None:
    result = value(f"x = {text}\n")
    if result is UNKNOWN or not is_known(result):
        return
    names = {"str": str, "int": int, "len": len}
    try:
        expected = eval(text, {"__builtins__": names})  # noqa: S307  built from the parts above
    except (ArithmeticError, TypeError, ValueError):
        # Both branches of a condition are the same, whatever becomes of the condition.
        expected = result if " if " in text else UNKNOWN
    assert result == expected
    assert type(result) is type(expected)
