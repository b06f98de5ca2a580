"""Python files as data: locations, imports, names, syntax errors."""

from __future__ import annotations

import ast
import codecs
import sys

import pytest
from hypothesis import given
from hypothesis import strategies as st

from scaffold.model.python.module import PythonModule
from scaffold.source import Location, NewerSyntaxError, ParseError, Source


def module(text: str, path: str = "demo/talker.py") -> PythonModule:
    return PythonModule.parse(Source(path, text))


def failure(text: str) -> ParseError:
    with pytest.raises(ParseError) as caught:
        module(text)
    return caught.value


def place(at: Location) -> tuple[int, int, int, int]:
    return at.line, at.column, at.end_line, at.end_column


# -- places


def test_columns_are_characters_not_bytes() -> None:
    view = module("größe = 'ä€𝄞' + name\n")
    binary = view.tree.body[0]
    assert isinstance(binary, ast.Assign)
    assert place(view.location(binary.targets[0])) == (1, 1, 1, 6)
    assert place(view.location(binary.value)) == (1, 9, 1, 21)
    assert view.text(binary.value) == "'ä€𝄞' + name"


@pytest.mark.parametrize("newline", ["\n", "\r\n", "\r"])
@pytest.mark.parametrize("bom", ["", "\ufeff"])
def test_spans_with_any_line_ending_and_byte_order_mark(newline: str, bom: str) -> None:
    text = bom + newline.join(["# ü", "first = 1", "zweite_größe = 'é'", ""])
    view = module(text)
    last = view.tree.body[1]
    assert view.text(last) == "zweite_größe = 'é'"
    start, end = view.span(last)
    assert text[start:end] == "zweite_größe = 'é'"
    assert view.has_bom == bool(bom)


def test_byte_order_mark_counts_as_a_character() -> None:
    view = module("\ufeffimport os\n")
    assert place(view.imports[0].location) == (1, 2, 1, 11)


def test_location_inside_an_f_string_is_the_whole_string() -> None:
    view = module("x = 1\ny = f'a {x} b'\n")
    used = view.walk(ast.Name)[-1]
    assert used.id == "x"
    assert view.text(used) == "f'a {x} b'"


def test_form_feed_does_not_end_a_line() -> None:
    view = module("a = 1\n\x0c\nb = 2\n")
    assert place(view.location(view.tree.body[1])) == (3, 1, 3, 6)


def test_nodes_without_a_location_have_that_of_their_parent() -> None:
    view = module("def f(a, b): pass\n")
    assert view.text(view.walk(ast.arguments)[0]) == "def f(a, b): pass"
    assert view.text(view.tree) == view.source.text


def test_walk_is_in_source_order() -> None:
    view = module("@first()\ndef f(a=second()):\n    return third(fourth())\nfifth()\n")
    names = [view.text(call.func) for call in view.walk(ast.Call)]
    assert names == ["first", "second", "third", "fourth", "fifth"]


# -- the file


def test_shebang() -> None:
    view = module("#!/usr/bin/env python3\r\nx = 1\r\n")
    assert view.is_script
    assert view.shebang == (
        "#!/usr/bin/env python3",
        Location("demo/talker.py", 1, 1, 1, 23),
    )


def test_shebang_after_a_byte_order_mark() -> None:
    view = module("\ufeff#!/usr/bin/python3\n")
    assert view.has_bom
    assert view.shebang is not None
    assert place(view.shebang[1]) == (1, 2, 1, 20)


def test_no_shebang() -> None:
    view = module("\n#!/usr/bin/python3\n")
    assert view.shebang is None
    assert not view.is_script


def test_docstring() -> None:
    assert module('"""Say hello.\n\n    More.\n"""\n').docstring == "Say hello.\n\n    More.\n"
    assert module("x = 1\n").docstring is None


@pytest.mark.parametrize(
    "test",
    ["__name__ == '__main__'", "'__main__' == __name__", "__name__ == '__main__' and enabled"],
)
def test_main_guard(test: str) -> None:
    view = module(f"x = 1\nif {test}:\n    main()\n")
    assert view.has_main_guard
    assert view.main_guard == Location("demo/talker.py", 2, 4, 2, 4 + len(test))


@pytest.mark.parametrize(
    "text",
    [
        "if __name__ != '__main__':\n    main()\n",
        "def f():\n    if __name__ == '__main__':\n        main()\n",
        "if name == '__main__':\n    main()\n",
        "main()\n",
    ],
)
def test_no_main_guard(text: str) -> None:
    assert not module(text).has_main_guard


@pytest.mark.parametrize(
    ("path", "expected"),
    [
        ("test/test_flake8.py", True),
        ("demo/test/helper.py", True),
        ("conftest.py", True),
        ("demo/talker_test.py", True),
        ("demo/testing.py", False),
        ("demo/latest.py", False),
    ],
)
def test_is_test_file(path: str, *, expected: bool) -> None:
    assert module("import os\n", path).in_tests is expected
    assert module("import os\n", path).imports[0].in_tests is expected


# -- import statements


IMPORTS = """\
import os, sys as system
from rclpy.node import Node, Publisher as Pub
from . import greeting
from ..shared.text import *
try:
    import cv2
except ImportError:
    cv2 = None
if TYPE_CHECKING:
    from std_msgs.msg import String
if sys.version_info >= (3, 11):
    import tomllib
if enabled:
    import torch


def f():
    import numpy
    with suppress(ModuleNotFoundError):
        import yaml


if __name__ == '__main__':
    import argparse
"""


def test_imports() -> None:
    view = module(IMPORTS)
    seen = [
        (item.module, item.level, tuple(name.name for name in item.names), item.asname)
        for item in view.imports
    ]
    assert seen == [
        ("os", 0, (), None),
        ("sys", 0, (), "system"),
        ("rclpy.node", 0, ("Node", "Publisher"), None),
        ("", 1, ("greeting",), None),
        ("shared.text", 2, ("*",), None),
        ("cv2", 0, (), None),
        ("std_msgs.msg", 0, ("String",), None),
        ("tomllib", 0, (), None),
        ("torch", 0, (), None),
        ("numpy", 0, (), None),
        ("yaml", 0, (), None),
        ("argparse", 0, (), None),
    ]


def test_import_locations() -> None:
    view = module(IMPORTS)
    os_, system, node = view.imports[:3]
    assert place(os_.location) == (1, 8, 1, 10)
    assert place(system.location) == (1, 12, 1, 25)
    assert place(node.location) == (2, 1, 2, 46)
    assert place(node.names[1].location) == (2, 30, 2, 46)
    assert node.names[1].asname == "Pub"


def test_context_of_imports() -> None:
    by_module = {
        item.module: item for item in module(IMPORTS.replace("sys as s", "sys; s")).imports
    }
    flags = {
        name: [
            flag
            for flag in ("top_level", "in_function", "guarded", "type_checking", "conditional")
            if getattr(item, flag)
        ]
        for name, item in by_module.items()
    }
    assert flags == {
        "os": ["top_level"],
        "sys": ["top_level"],
        "rclpy.node": ["top_level"],
        "": ["top_level"],
        "shared.text": ["top_level"],
        "cv2": ["guarded"],
        "std_msgs.msg": ["guarded", "type_checking"],
        "tomllib": ["guarded"],
        "torch": ["conditional"],
        "numpy": ["in_function"],
        "yaml": ["in_function", "guarded"],
        "argparse": [],
    }


def test_imports_by_root() -> None:
    view = module("import os.path\nimport os\nfrom . import os as own\nfrom osgeo import gdal\n")
    assert {root: len(result) for root, result in view.imports_by_root.items()} == {
        "os": 2,
        "osgeo": 1,
    }


def test_import_in_the_else_of_type_checking_is_executed() -> None:
    view = module("if TYPE_CHECKING:\n    import a\nelse:\n    import b\n")
    assert [(item.module, item.type_checking) for item in view.imports] == [
        ("a", True),
        ("b", False),
    ]


# -- names


def test_name_locations_of_functions_and_classes() -> None:
    view = module(
        "def main(args=None):\n    pass\n\n\nasync  def  wait():\n    pass\n\n\n"
        "@decorated\nclass Talker(Node):\n    def inner(self):\n        pass\n"
    )
    assert {name: place(result.location) for name, result in view.functions.items()} == {
        "main": (1, 5, 1, 9),
        "wait": (5, 13, 5, 17),
    }
    assert {name: place(result.location) for name, result in view.classes.items()} == {
        "Talker": (10, 7, 10, 13),
    }


@pytest.mark.parametrize(
    "text",
    [
        "def main(): pass",
        "class main: pass",
        "main = run",
        "main: int = 1",
        "from app import main",
        "from app import run as main",
        "import main",
        "try:\n    from app import main\nexcept ImportError:\n    pass",
        "for main in (): pass",
        "with a as main: pass",
        "(main := 1)",
        "if True:\n    main = 1",
        "def f():\n    global main\n    main = 1",
        "a, (main, b) = x",
    ],
)
def test_defines(text: str) -> None:
    assert module(text + "\n").defines("main") is True


@pytest.mark.parametrize(
    "text",
    [
        "x = 1",
        "import os.main",
        "def f():\n    main = 1",
        "class A:\n    main = 1",
        "main: int",
        "[main for main in x]",
        "lambda main: 1",
    ],
)
def test_does_not_define(text: str) -> None:
    assert module(text + "\n").defines("main") is False


@pytest.mark.parametrize(
    "text",
    [
        "from app import *",
        "def __getattr__(name): return 1",
        "globals()['main'] = 1",
        "exec('main = 1')",
        "main = 1\ndel main",
    ],
)
def test_defined_names_are_unknown(text: str) -> None:
    assert module(text + "\n").defines("main") is None


def qualified(text: str) -> str | None:
    """Return the qualified name of the expression on the last line."""
    view = module(text)
    return view.qualified_name(
        max(
            (node for node in view.walk(ast.Expr)),
            key=lambda node: node.lineno,
        ).value
    )


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("from rclpy.node import Node\nNode\n", "rclpy.node.Node"),
        ("from rclpy.node import Node as N\nN\n", "rclpy.node.Node"),
        ("import rclpy.node\nrclpy.node.Node\n", "rclpy.node.Node"),
        ("import rclpy.node as rn\nrn.Node\n", "rclpy.node.Node"),
        ("from rclpy import node\nnode.Node\n", "rclpy.node.Node"),
        ("from .base import Base\nBase\n", ".base.Base"),
        ("from . import base\nbase.Base\n", ".base.Base"),
        ("print\n", "print"),
        ("KeyboardInterrupt\n", "KeyboardInterrupt"),
        ("from a import *\nprint\n", None),
        ("from a import *\nKeyboardInterrupt\n", "KeyboardInterrupt"),
        ("from a import b\nb = 1\nb\n", None),
        ("def b(): pass\nb\n", None),
        ("unknown\n", None),
        ("f().x\n", None),
        ("from a import b\ndef f(b):\n    b\n", None),
        ("def f():\n    from a import b\n    b\n", "a.b"),
        ("from a import b\nclass C:\n    b = 1\n    def f(self):\n        b\n", "a.b"),
        ("from a import b\nclass C:\n    b = 1\n    b\n", None),
        ("try:\n    from a import b\nexcept ImportError:\n    from c import b\nb\n", None),
    ],
)
def test_qualified_name(text: str, expected: str | None) -> None:
    assert qualified(text) == expected


def test_qualified_names_of_alternatives() -> None:
    view = module("try:\n    from a import b\nexcept ImportError:\n    from c import b\nb.d\n")
    last = view.tree.body[-1]
    assert isinstance(last, ast.Expr)
    assert view.qualified_names(last.value) == {"a.b.d", "c.b.d"}


def test_scopes_of_comprehensions_lambdas_and_defaults() -> None:
    view = module("x = 1\n\n\ndef f(a=x, x=2):\n    return [x for x in x], (lambda x: x)\n")
    uses = [node for node in view.walk(ast.Name) if isinstance(node.ctx, ast.Load)]
    owners = []
    for use in uses:
        result = view.index.lookup(use.id, use)
        assert result is not None
        owners.append(type(result[0]).__name__)
    assert owners == ["Module", "ListComp", "FunctionDef", "Lambda"]


# -- encodings


def test_coding_cookie() -> None:
    data = "#!/usr/bin/env python3\n# -*- coding: latin-1 -*-\nname = 'Jürgen'\n".encode("latin-1")
    view = PythonModule.parse_bytes("a.py", data)
    assert view.source.encoding == "latin-1"
    assert view.source.text.encode(view.source.encoding) == data
    assert view.text(view.tree.body[0]) == "name = 'Jürgen'"


def test_coding_cookie_only_in_first_two_lines() -> None:
    for text in ("\n\n# coding: latin-1\n", "x = 1\n# coding: latin-1\n"):
        assert PythonModule.parse_bytes("a.py", text.encode()).source.encoding == "utf-8"


def test_byte_order_mark_overrides_the_default_encoding() -> None:
    view = PythonModule.parse_bytes("a.py", codecs.BOM_UTF8 + b"# coding: utf-8\nx = 1\n")
    assert view.has_bom
    assert view.source.encoding == "utf-8"


@pytest.mark.parametrize(
    ("data", "line", "message"),
    [
        (b"x = 1\ny = '\xff'\n", 2, "byte 0xff is not valid UTF-8"),
        (b"# coding: klingon\n", 1, "the declared encoding 'klingon' is not known"),
        (b"# coding: hex\n", 1, "the declared encoding 'hex' is not known"),
        (b"# coding: undefined\n", 1, "the bytes are not valid UNDEFINED"),
    ],
)
def test_undecodable_bytes(data: bytes, line: int, message: str) -> None:
    with pytest.raises(ParseError) as caught:
        PythonModule.parse_bytes("a.py", data)
    assert caught.value.message == message
    assert caught.value.location.line == line


# -- broken files


@pytest.mark.parametrize(
    ("text", "message", "at"),
    [
        ("x = (1,\ny = 2\n", "'(' is never closed", (1, 5, 1, 6)),
        ("größe = (1,\n", "'(' is never closed", (1, 9, 1, 10)),
        ("\ufeffx = [\n", "'[' is never closed", (1, 6, 1, 7)),
        ("x = 1)\n", "')' closes nothing", (1, 6, 1, 7)),
        ("x = (1]\n", "']' does not close '('", (1, 7, 1, 8)),
        ("x = (\n1]\n", "']' does not close '(' of line 1", (2, 2, 2, 3)),
        ("x = 'abc\n", "a string is not closed on its line", (1, 5, 1, 6)),
        ("x = 1\n'''abc\n", "a triple-quoted string is never closed", (2, 1, 2, 2)),
        ("def f()\n    pass\n", "':' is missing", (1, 8, 1, 8)),
        ("x = 1\n    y = 2\n", "unexpected indentation", (2, 5, 2, 10)),
        ("def f():\npass\n", "the block of line 1 is not indented", (2, 1, 2, 5)),
        (
            "if a:\n        b\n    c\n",
            "the indentation matches no block around it",
            (3, 5, 3, 6),
        ),
        (
            "if a:\n        b\n\tc\n",
            "tabs and spaces are mixed in the indentation",
            (3, 2, 3, 3),
        ),
        (
            "print 'hello'\n",
            "print is a function in Python 3: write print(...)",
            (1, 1, 1, 2),
        ),
        ("f(a b)\n", "invalid syntax, perhaps a comma is missing", (1, 3, 1, 4)),
        ("x = = 1\n", "invalid syntax", (1, 5, 1, 6)),
        ("x = 1\0\n", "a NUL character in the source", (1, 6, 1, 7)),
        ("x = " + "9" * 5000 + "\n", "a number has too many digits", (1, 1, 1, 2)),
        ("try:\n    x\nexcept A, e:\n    y\n", "several exceptions need parentheses", (3, 8, 3, 9)),
        ("def f[T=int](x): pass\n", "needs Python 3.13, but ROS 2 Jazzy has 3.12", None),
    ],
)
def test_syntax_error(text: str, message: str, at: tuple[int, int, int, int] | None) -> None:
    error = failure(text)
    assert error.message == message
    assert at is None or place(error.location) == at


@pytest.mark.parametrize(
    "text",
    [
        "(" * 20_000 + ")" * 20_000,
        "[" * 100_000,
        "-" * 50_000 + "1",
        "not " * 20_000 + "1",
        "x = a" + ".b" * 20_000,
        "x = " + "1+" * 20_000 + "1",
        "x = " + "'a' " * 10 + "+ 'b'" * 5_000,
        "lambda:" * 5_000 + "1",
        "".join(" " * depth + "if 1:\n" for depth in range(120)) + " " * 120 + "pass\n",
        "f(" * 5_000,
        "x = " + "{1:" * 5_000,
    ],
)
def test_deep_nesting_is_rejected(text: str) -> None:
    assert failure(text).message in {"nested too deeply", "'[' is never closed"}


def test_nesting_of_real_generated_code_is_accepted() -> None:
    chain = "if a == 0:\n    pass\n" + "".join(f"elif a == {n}:\n    pass\n" for n in range(100))
    assert len(module(chain).walk(ast.If)) == 101


def test_huge_file_is_rejected() -> None:
    assert failure("x = 1\n" * 400_000).message == (
        "too large to be read: more than 2000000 characters"
    )


@pytest.mark.filterwarnings("error")
def test_invalid_escape_sequence_is_no_error() -> None:
    assert module("x = '\\d'\n").defines("x")


NEWER = [
    ("try:\n    pass\nexcept* ValueError:\n    pass\n", (3, 11)),
    ("x = a[*b]\n", (3, 11)),
    ("def f(*args: *Ts): pass\n", (3, 11)),
    ("type Name = str\n", (3, 12)),
    ("def first[T](items: list[T]) -> T: ...\n", (3, 12)),
    ("class Box[T]: ...\n", (3, 12)),
    ("x = f'{d['key']}'\n", (3, 12)),
    ("x = f'{'\\n'.join(lines)}'\n", (3, 12)),
    ("x = f'{a  # why\n}'\n", (3, 12)),
    ("x = f'{f'{f'{1}'}'}'\n", (3, 12)),
]


@pytest.mark.parametrize(("text", "version"), NEWER)
def test_newer_syntax_is_recognized(text: str, version: tuple[int, int]) -> None:
    if sys.version_info >= version:
        assert module(text).tree.body
        return
    with pytest.raises(NewerSyntaxError) as caught:
        module(text)
    assert caught.value.version == version
    assert str(caught.value) == f"needs Python {version[0]}.{version[1]} or newer"


@pytest.mark.parametrize(
    "text",
    ["x = f'{a b}'\n", "x = f'{'\n", "x = f'{}'\n", "x = f'{a!z}'\n", "f'{d['\n", "f'{a'\n"],
)
def test_broken_f_string_is_an_error_on_every_python(text: str) -> None:
    assert failure(text).location.line == 1


# -- anything


TOKENS = [
    "def f(",
    "):",
    "    ",
    "class A",
    "[",
    "]",
    "(",
    ")",
    "{",
    "}",
    "'",
    '"',
    "f'",
    "'''",
    "x",
    "=",
    " = 1",
    "import a",
    "from . import b",
    "#",
    "\\",
    "ä",
    "€",
    "if __name__ == '__main__':",
    "global x",
    "del x",
    "lambda x: x",
    ",",
    "for x in y:",
    "match x:",
    "case _:",
    "async ",
    "await ",
    "yield",
    "type X = int",
    "*",
    "try:",
    "except* A:",
    "except:",
    ":=",
    "0x",
    "1e999",
    "with a as b:",
]
PYTHON_LIKE = st.lists(
    st.sampled_from([*TOKENS, "\n", "\t", "\r", "\r\n", "\x0c", "\ufeff", "\0", "\ud800"]),
    max_size=40,
).map("".join)
CODECS = [
    "utf-16",
    "utf-7",
    "unicode_escape",
    "idna",
    "punycode",
    "rot13",
    "cp037",
    "utf-32",
    "latin-1",
    "mbcs",
    "raw_unicode_escape",
    "hz",
    "big5",
    "gbk",
    "utf_8_sig",
    "ascii",
]


def use_everything(view: PythonModule) -> None:
    """Access all properties of a module: none may fail."""
    for node in ast.walk(view.tree):
        start, end = view.span(node)
        assert 0 <= start <= end <= len(view.source.text)
        view.qualified_names(node)
        view.index.scope_of(node)
    assert all(item.location.line >= 1 for item in view.imports)
    assert set(view.functions).isdisjoint({""})
    for name in ("x", "main"):
        assert view.defines(name) in {True, False, None}
    assert view.main_guard is None or view.has_main_guard
    assert view.docstring is None or view.docstring.isascii() in {True, False}


@given(st.text() | PYTHON_LIKE)
def test_any_text_gives_a_module_or_a_parse_error(text: str) -> None:
    view: PythonModule | None = None
    try:
        view = module(text)
    except (ParseError, NewerSyntaxError) as error:
        at = error.location
    else:
        at = view.location(view.tree)
    assert at.line >= 1
    assert at.column >= 1
    if view:
        use_everything(view)


COOKIES = st.sampled_from(CODECS).map(lambda name: f"# coding: {name}\n".encode())


@given(st.builds(bytes.__add__, st.just(b"") | COOKIES, st.binary()))
def test_any_bytes_give_a_module_or_a_parse_error(data: bytes) -> None:
    try:
        view = PythonModule.parse_bytes("a.py", data)
    except (ParseError, NewerSyntaxError):
        return
    use_everything(view)


SNIPPETS = st.lists(
    st.sampled_from(
        [
            "import os",
            "x = 'ä'",
            "def f(a, *b, c=1, **d):\n    return a",
            "class A(B):\n    x: int = 1",
            "print(f'{x!r:>{w}} {y}')",
            "[a for a in b if a]",
            "match x:\n    case {'a': b, **c}:\n        pass",
            "with a as (b, c):\n    d = e = 'é€'; f = g",
            "try:\n    pass\nexcept A as e:\n    raise",
        ]
    ),
    max_size=6,
)


@given(SNIPPETS, st.sampled_from(["\n", "\r\n", "\r"]), st.sampled_from(["", "\ufeff"]))
def test_spans_equal_those_of_ast(snippets: list[str], newline: str, bom: str) -> None:
    plain = "\n".join([*snippets, ""])
    view = module(bom + plain.replace("\n", newline))
    for node in ast.walk(view.tree):
        inside = any(isinstance(parent, ast.JoinedStr) for parent in view.parents(node))
        if hasattr(node, "lineno") and not inside:
            expected = ast.get_source_segment(plain, node)
            assert view.text(node).replace(newline, "\n") == expected


def test_nodes_below_a_function() -> None:
    text = "def f():\n    while a:\n        def g():\n            while b:\n                c()\n"
    module, other = (PythonModule.parse(Source("a.py", text)) for _ in range(2))
    for function in (*module.function_nodes, *other.function_nodes):
        loops = [node.lineno for node in module.below(function, ast.While)]
        assert loops == ([2, 4] if function.name == "f" else [4])
        kinds = [type(node) for node in module.below(function, ast.Call, ast.While)]
        assert set(kinds) == {ast.Call, ast.While}
    assert [*module.below(module.function_nodes[1], ast.Return)] == []
