"""``check --reference``: compares the reimplementation with pydocstyle itself.

It is slow, because it imports pydocstyle and reads every file again. A difference is a bug in
ros2-scaffold, never in the checked package.
"""

from __future__ import annotations

import ast
import logging
import os
import tempfile
import warnings
from collections.abc import Iterator, Sequence
from importlib import import_module
from typing import Any

from scaffold.ament.files import select
from scaffold.ament.finding import PEP257
from scaffold.ament.pep257 import form as docstrings
from scaffold.ament.pep257.codes import AMENT
from scaffold.ament.python_text.text import PythonText, decode
from scaffold.model.package import Package
from scaffold.record import NamedTuple


class Difference(NamedTuple):
    """A code that only one side reports at a line."""

    path: str
    line: int
    code: str
    only_reference: bool
    """Whether only pydocstyle reports it; otherwise only we do."""

    @property
    def message(self) -> str:
        """The difference in one line."""
        who = "pydocstyle" if self.only_reference else "ros2-scaffold"
        return f"only {who} reports {self.code}"


def differences(packages: Sequence[Package]) -> Iterator[tuple[Package, Difference]]:
    """Yield where pydocstyle and our docstring rules disagree, in reading order."""
    for package in packages:
        for path, linters in select(package.tree.files).items():
            if linters & PEP257:
                for difference in _of_file(path, package.tree.read(path)):
                    yield package, difference


def _of_file(path: str, data: bytes) -> list[Difference]:
    decoded = decode(data)
    text = PythonText(path.rpartition("/")[2], decoded.text)
    if not decoded.is_clean or text.tree is None:
        return []
    expected = _reference(path.rpartition("/")[2], data)
    if expected is None:
        return []
    ours = {(item.line, item.code) for item in docstrings.check(text) if item.linters & PEP257}
    return [
        Difference(path, line, code, only_reference=(line, code) in expected)
        for line, code in sorted(ours ^ expected)
    ]


def _literal(text: str, _: object) -> object:
    return ast.literal_eval(text)


def load() -> Any:  # noqa: ANN401  it has no types
    """Return the module pydocstyle, patched to be safe and silent."""
    pydocstyle = import_module("pydocstyle")
    # It evaluates the value of `__all__`, where an f-string may call anything.
    vars(import_module("pydocstyle.parser"))["eval"] = _literal
    logging.getLogger("pydocstyle").setLevel(logging.CRITICAL)
    return pydocstyle


def _reference(name: str, data: bytes) -> set[tuple[int, str]] | None:
    """Return the lines and codes of pydocstyle; ``None`` if it crashes on the file."""
    pydocstyle = load()
    with tempfile.TemporaryDirectory(prefix="ros2-scaffold-") as scratch:
        file = os.path.join(scratch, name)
        with open(file, "wb") as out:
            out.write(data)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            try:
                violations = list(pydocstyle.check([file], select=AMENT))
            except Exception:  # noqa: BLE001  whatever pydocstyle stumbles over
                return None
    if not all(isinstance(item, pydocstyle.Error) for item in violations):
        return None
    return {(item.line, item.code) for item in violations}
