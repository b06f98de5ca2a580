"""Facts: values computed from files, cached by their dependencies."""

from __future__ import annotations

import marshal
from typing import Any

import pytest

from scaffold.model.contents.python_facts import exports_of, imports_of
from scaffold.model.fact_values import decode, encode
from scaffold.model.package import Package
from scaffold.model.python.evaluation.values import UNKNOWN
from scaffold.model.python.module import PythonModule
from scaffold.model.reads import Reads, recorded
from scaffold.source import Location, ParseError

VALUES = [
    *(None, "a", 1, 1.5, float("inf"), True, b"a", UNKNOWN, (), []),
    *(("a", (1, 2.0)), ["a", True], {"a": (1,)}, frozenset({("a", None)})),
    *(Location("a.py", 1, 2, 3, 4), (Location("a.py", 1, 2, 3, 4), UNKNOWN)),
]


@pytest.mark.parametrize("value", VALUES, ids=repr)
def test_stored_values_round_trip(value: object) -> None:
    encoded: Any = encode(value)
    read = decode(marshal.loads(marshal.dumps(encoded)))  # noqa: S302  own bytes
    assert (read, type(read)) == (value, type(value))


@pytest.mark.parametrize(("value", "other"), [(1, 1.0), (1, True), (0.0, False), ((), [])])
def test_equal_values_of_different_types_are_distinguished(value: object, other: object) -> None:
    assert encode(value) != encode(other)


def test_unsupported_values_are_rejected() -> None:
    with pytest.raises(TypeError, match="PythonModule"):
        encode((PythonModule.parse_bytes("a.py", b""),))


def test_caller_of_a_fact_depends_on_the_fact_and_not_on_the_file() -> None:
    package = Package.of({"a.py": "import os\n"})
    reads = Reads()
    with recorded(reads):
        imports_of(package, "a.py")
    files, facts = reads.all()
    assert not files
    assert [fact.key[1:] for fact in facts] == [("a.py",)]
    assert [fact.stored()[0].files for fact in facts] == [frozenset({"/a.py"})]


def test_fact_of_a_broken_file_raises_every_time() -> None:
    package = Package.of({"a.py": "import\n"})
    for _ in range(2):
        with pytest.raises(ParseError):
            imports_of(package, "a.py")


@pytest.mark.parametrize(
    ("text", "name", "expected"),
    [
        ("x = 1\n", "x", True),
        ("x = 1\n", "y", False),
        ("x = 1\n", "__file__", True),
        ("x: int\n", "x", False),
        ("x = 1\ndel x\n", "x", None),
        ("from os import *\n", "y", None),
        ("def __getattr__(name):\n    return 1\n", "y", None),
    ],
)
def test_exports_equal_those_of_the_module(text: str, name: str, expected: bool | None) -> None:
    package = Package.of({"a.py": text})
    assert exports_of(package, "a.py").defines(name) is expected
    assert package.module("a.py").defines(name) is expected
