"""Fixes of Python style: their result, their limits, and the findings afterwards."""

from __future__ import annotations

import ast
import inspect
import warnings
from collections import Counter
from collections.abc import Callable
from pathlib import Path

import pytest

from scaffold.ament import StyleCheck
from scaffold.ament.codes import CODES
from scaffold.check.fixes import fixer
from scaffold.diagnostic import Diagnostic
from scaffold.edits import Safety
from scaffold.model.package import Package
from tests import oracles
from tests.ament import style_cases

Codes = Counter[tuple[str, str]]


def check(package: Package) -> list[Diagnostic]:
    return StyleCheck([package]).diagnostics(package)


def check_only(code: str) -> Callable[[Package], list[Diagnostic]]:
    return lambda package: [finding for finding in check(package) if finding.code == code]


FIXED = {
    # what is reported, and what a fix of that code alone makes of it
    "D200": (
        'def f():\n    """\n    Go.\n    """\n    return 1\n',
        'def f():\n    """Go."""\n    return 1\n',
    ),
    "D201": (
        'def f():\n\n    """Go."""\n    return 1\n',
        'def f():\n    """Go."""\n    return 1\n',
    ),
    "D202": (
        'def f():\n    """Go."""\n\n\n    def g():\n        return 1\n    return g\n',
        'def f():\n    """Go."""\n\n    def g():\n        return 1\n    return g\n',
    ),
    "D204": (
        'class A:\n    """Go."""\n    x = 1\n',
        'class A:\n    """Go."""\n\n    x = 1\n',
    ),
    "D205": (
        '"""\nGo.\n\n\nThere.\n"""\n',
        '"""\nGo.\n\nThere.\n"""\n',
    ),
    "D207": (
        'def f():\n    """\n  Go.\n\n    There.\n    """\n    return 1\n',
        'def f():\n    """\n    Go.\n\n      There.\n    """\n    return 1\n',
    ),
    "D208": (
        'def f():\n    """\n      Go.\n\n        There.\n      """\n    return 1\n',
        'def f():\n    """\n    Go.\n\n      There.\n    """\n    return 1\n',
    ),
    "D209": (
        '"""\nGo.\n\nThere."""\n',
        '"""\nGo.\n\nThere.\n"""\n',
    ),
    "D210": ('""" Go. """\n', '"""Go."""\n'),
    "D211": (
        'class A:\n\n    """Go."""\n\n    x = 1\n',
        'class A:\n    """Go."""\n\n    x = 1\n',
    ),
    "D213": (
        'def f():\n    """Go.\n\n    There.\n    """\n    return 1\n',
        'def f():\n    """\n    Go.\n\n    There.\n    """\n    return 1\n',
    ),
    "D215": (
        '"""\nGo.\n\nNotes\n  -----\nThere.\n\n"""\n',
        '"""\nGo.\n\nNotes\n-----\nThere.\n\n"""\n',
    ),
    "D300": ("'''Go.'''\n", '"""Go."""\n'),
    "D301": ('"""Go \\d."""\n', 'r"""Go \\d."""\n'),
    "D400": ('"""Go"""\n', '"""Go."""\n'),
    "D403": (
        'def f():\n    """go there."""\n    return 1\n',
        'def f():\n    """Go there."""\n    return 1\n',
    ),
    "D405": (
        '"""\nGo.\n\nnotes\n-----\nThere.\n\n"""\n',
        '"""\nGo.\n\nNotes\n-----\nThere.\n\n"""\n',
    ),
    "D406": (
        '"""\nGo.\n\nNotes:\n-----\nThere.\n\n"""\n',
        '"""\nGo.\n\nNotes\n-----\nThere.\n\n"""\n',
    ),
    "D407": (
        '"""\nGo.\n\nNotes\nThere.\n\n"""\n',
        '"""\nGo.\n\nNotes\n-----\nThere.\n\n"""\n',
    ),
    "D408": (
        '"""\nGo.\n\nNotes\n\n-----\nThere.\n\n"""\n',
        '"""\nGo.\n\nNotes\n-----\nThere.\n\n"""\n',
    ),
    "D409": (
        '"""\nGo.\n\nNotes\n--\nThere.\n\n"""\n',
        '"""\nGo.\n\nNotes\n-----\nThere.\n\n"""\n',
    ),
    "D410": (
        '"""\nGo.\n\nNotes\n-----\nThere.\nReferences\n----------\nHere.\n\n"""\n',
        '"""\nGo.\n\nNotes\n-----\nThere.\n\nReferences\n----------\nHere.\n\n"""\n',
    ),
    "D411": (
        '"""\nGo.\nNotes\n-----\nThere.\n\n"""\n',
        '"""\nGo.\n\nNotes\n-----\nThere.\n\n"""\n',
    ),
    "D412": (
        '"""\nGo.\n\nNotes\n-----\n\nThere.\n\n"""\n',
        '"""\nGo.\n\nNotes\n-----\nThere.\n\n"""\n',
    ),
    "D413": (
        '"""\nGo.\n\nNotes\n-----\nThere.\n"""\n',
        '"""\nGo.\n\nNotes\n-----\nThere.\n\n"""\n',
    ),
    "D415": ('"""Go"""\n', '"""Go."""\n'),
    "D416": (
        '"""\nGo.\n\nTip\n    There.\n\n"""\n',
        '"""\nGo.\n\nTip:\n    There.\n\n"""\n',
    ),
    "E203": ("x = [1, 2]\nx[0 : 1]\n", "x = [1, 2]\nx[0:1]\n"),
    "E701": ("x = 1\nif x: x = 2\n", "x = 1\nif x:\n    x = 2\n"),
    "E702": ("x = 1; y = 2\n", "x = 1\ny = 2\n"),
    "E703": ("x = 1;\n", "x = 1\n"),
    "E713": ("x = [1]\nif not 1 in x:\n    x = 2\n", "x = [1]\nif 1 not in x:\n    x = 2\n"),
    "F401": ("import os\nx = 1\n", "x = 1\n"),
    "F541": ("x = f'1'\n", "x = '1'\n"),
    "I101": (
        "from os import (\n    walk,\n    path,\n)\nwalk(path)\n",
        "from os import (\n    path,\n    walk,\n)\nwalk(path)\n",
    ),
    "W391": ("x = 1\n\n  \n\n", "x = 1\n"),
    "W605": ("x = '\\d'\n", "x = r'\\d'\n"),
}


@pytest.mark.parametrize("code", FIXED)
def test_fix_of_code(code: str) -> None:
    before, after = FIXED[code]
    fixed = fixer.fix(Package.of({"a.py": before}), check_only(code))
    assert fixed.changed["a.py"].decode() == after
    assert check_only(code)(fixed.package) == []


@pytest.mark.parametrize(
    ("before", "after"),
    [
        ('"""Go\n\n\\\\alpha there.\n"""\n', '"""\nGo.\n\n\\\\alpha there.\n"""\n'),
        ('"""\\\\alpha\n\nThere.\n"""\n', '"""\\\\alpha\n\nThere.\n"""\n'),
        ('r"""Go \\d\n\nthere.\n"""\n', 'r"""\nGo \\d.\n\nthere.\n"""\n'),
    ],
)
def test_docstrings_with_backslashes(before: str, after: str) -> None:
    fixed = fixer.fix(Package.of({"a.py": before}), check)
    assert fixed.changed.get("a.py", before.encode()).decode() == after


def test_docstrings_for_doxygen_are_left_alone() -> None:
    text = '"""!\n@brief Go\nthere\n"""\n\n\ndef go():\n    """! Go there"""\n'
    package = Package.of({"a.py": text})
    assert {"D205", "D213", "D415"} & {item.code for item in check(package)}
    assert fixer.fix(package, check).changed == {}


@pytest.mark.parametrize(
    "statement",
    [
        "import tf2_geometry_msgs\n",
        "import tf2_geometry_msgs as conversions\n",
        "from tf2_sensor_msgs import do_transform_cloud\n",
    ],
)
def test_imports_that_register_tf2_conversions_are_kept(statement: str) -> None:
    package = Package.of({"a.py": statement})
    assert [item.code for item in check_only("F401")(package)] == ["F401"]
    assert not fixer.fix(package, check_only("F401")).changed


UNSAFE = {
    "C400": ("x = [1]\nlist(y for y in x)\n", "x = [1]\nlist(x)\n"),
    "D401": (
        'def f():\n    """Returns it."""\n    return 1\n',
        'def f():\n    """Return it."""\n    return 1\n',
    ),
    "E711": ("x = 1\nif x == None:\n    x = 2\n", "x = 1\nif x is None:\n    x = 2\n"),
}


@pytest.mark.parametrize("code", UNSAFE)
def test_unsafe_fix_of_code(code: str) -> None:
    before, after = UNSAFE[code]
    package = Package.of({"a.py": before})
    assert fixer.fix(package, check_only(code)).changed == {}
    fixed = fixer.fix(package, check_only(code), unsafe=True)
    assert fixed.changed["a.py"].decode() == after


@pytest.mark.parametrize(
    "kept",
    [
        # words, not form
        '"""\nGo there\nand back.\n"""\n',
        '"""Go: http://ros.example.org/a"""\n',
        '"""Go!"""\n',
        '"""Go there:"""\n',
        '"""a.py"""\n',
        'def f():\n    """readIt goes."""\n    return 1\n',
        # what would melt into the quotes
        'def f():\n    """\n    "Go."\n    """\n    return 1\n',
        "'''Go \"\"\" there.'''\n",
        # escapes that mean something
        '"""Go\\n there."""\n',
        # no docstring for Python
        'def f():\n    """Go""".strip()\n    return 1\n',
        'x = "a" "b"  # noqa\n',
        # longer than a line may be
        f'def f():\n    """\n    {"Go " * 29}there.\n    """\n    return 1\n',
        # behind dashes the arguments would not be found
        'def f(x):\n    """\n    Go.\n\n    Args:\n        x: it\n\n    """\n    return x\n',
        # half of it would be of another convention afterwards
        '"""\nGo.\n\nArgs:\n    x: It.\n\nReturns:\n    That.\n\n"""\n',
        '"""\nGo.\n\nReturns:\n    That.\n\n"""\n',
        '"""\nGo.\n\nNotes:\nThere.\n\nExample:\nHere.\n\n"""\n',
        '"""\nGo.\n\nTip\n---\nThere.\n\n"""\n',
        # the blanks are seen
        "x = 1\nprint(f'{x = }')\n",
        # something is aligned with it
        "x = 1\nprint(x [0], (x,\n              x))\n",
        # silenced
        'def f():  # noqa: D400, D415\n    """Go"""  # noqa\n    return 1\n',
    ],
)
def test_unsafe_edits_are_not_made(kept: str) -> None:
    assert fixer.fix(Package.of({"a.py": kept}), check).changed == {}


def test_many_findings_in_a_line_are_fixed_at_once() -> None:
    before = "x = [" + ", ".join(['""'] * 20) + "]\n"
    fixed = fixer.fix(Package.of({"a.py": before}), check)
    assert fixed.applied == 1
    assert check(fixed.package) == []


def test_table_of_fixable_codes() -> None:
    assert {CODES[code].fix for code in FIXED} == {Safety.SAFE}
    assert {CODES[code].fix for code in UNSAFE} == {Safety.UNSAFE}


# -- all cases that the verdicts are tested with


def cases() -> dict[str, bytes]:
    result: list[str] = []
    for group in (
        "WHITESPACE_AND_STATEMENTS",
        "LINES_AND_NOQA",
        "CONTINUATION_LINES",
        "IMPORTS",
        "COMPREHENSIONS",
    ):
        result += getattr(style_cases, group)
    bodies, places = style_cases.DOCSTRINGS, style_cases.DOCSTRING_PLACES
    result += [
        places[at].format(body)
        for number, body in enumerate(bodies)
        for at in {0, 5, number % len(places)}
        if 'f"""' not in body
    ]
    return {f"case_{at:04}.py": case.encode() for at, case in enumerate(result) if parsed(case)}


def parsed(text: str | bytes) -> ast.Module | None:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            compile(text, "a.py", "exec")
            return ast.parse(text)
        except (SyntaxError, ValueError):
            return None


def meaning(text: bytes) -> str:
    """Return the syntax tree as text; docstrings are compared by their letters."""
    tree = parsed(text)
    assert tree is not None, text
    for node in ast.walk(tree):
        if isinstance(node, (ast.Module, ast.ClassDef, ast.FunctionDef, ast.AsyncFunctionDef)):
            first = node.body[0] if node.body else None
            if isinstance(first, ast.Expr) and isinstance(first.value, ast.Constant):
                value = first.value.value
                if isinstance(value, str):
                    letters = filter(str.isalnum, inspect.cleandoc(value).lower())
                    first.value.value = "".join(letters)
                first.value.kind = None
    return ast.dump(tree)


def is_formatting(one: Diagnostic) -> bool:
    return one.code.startswith(("D", "E1", "E2", "E3", "E70", "Q", "W1", "W2", "W3"))


def test_formatting_fixes_do_not_change_the_syntax_tree() -> None:
    before = cases()
    fixed = fixer.fix(Package.of(before), lambda package: [*filter(is_formatting, check(package))])
    differing = [
        before[path]
        for path, data in fixed.changed.items()
        if meaning(before[path]) != meaning(data)
    ]
    assert differing == []


@pytest.mark.parametrize("unsafe", [False, True])
def test_fixes_converge(*, unsafe: bool) -> None:
    fixed = fixer.fix(Package.of(cases()), check, unsafe=unsafe)
    assert all(parsed(data) for data in fixed.changed.values())
    again = fixer.fix(fixed.package, check, unsafe=unsafe)
    assert again.changed == {}
    fixes = {
        (finding.code, finding.fix.safety) for finding in check(Package.of(cases())) if finding.fix
    }
    wrong = [code for code, safety in fixes if CODES[code].fix not in {safety, Safety.SAFE}]
    assert wrong == []


def test_linters_find_nothing_new_after_fixes(tmp_path: Path) -> None:
    before = cases()
    fixed = fixer.fix(Package.of(before), check)
    result: list[Codes] = []
    for name, files in (("before", before), ("after", {**before, **fixed.changed})):
        directory = tmp_path / name
        directory.mkdir()
        for path, data in files.items():
            (directory / path).write_bytes(data)
        diagnostics = oracles.ament_flake8(directory) | oracles.ament_pep257(directory)
        # One line that became two has its undefined names on both.
        result.append(
            Counter(
                (finding.path, finding.code) for finding in diagnostics if finding.code != "F821"
            )
        )
    was, now = result
    new = {key: count for key, count in now.items() if count > was[key]}
    assert {(before[path], code): count for (path, code), count in new.items()} == {}
    assert total(now) < total(was) * 0.8


def total(found: Codes) -> int:
    return sum(found.values())
