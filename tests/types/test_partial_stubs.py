"""Partial stubs of Python libraries accept everything that the libraries have."""

from __future__ import annotations

import ast

import numpy as np
import pytest

from scaffold.types.stubs.libraries import partial_libraries, partial_stubs


@pytest.mark.parametrize("path", sorted(partial_stubs()))
def test_other_names_in_a_stub_are_any(path: str) -> None:
    assert "def __getattr__(name: str) -> Any: ..." in partial_stubs()[path]


def test_array_has_the_attributes_of_numpy() -> None:
    stub = ast.parse(partial_stubs()["numpy/__init__.pyi"])
    class_ = next(node for node in stub.body if isinstance(node, ast.ClassDef))
    names = {node.name for node in class_.body if isinstance(node, ast.FunctionDef)}
    names |= {ast.unparse(node.target) for node in class_.body if isinstance(node, ast.AnnAssign)}
    assert set(dir(np.ndarray)) <= names | set(dir(object))


def test_each_library_is_a_package() -> None:
    assert {f"{name}/__init__.pyi" for name in partial_libraries()} <= {*partial_stubs()}
