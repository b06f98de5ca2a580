"""The entry points in setup.py, among them the executables of a package."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator

from scaffold.formats.ini import IniOption
from scaffold.model.python.evaluation.evaluator import Evaluator
from scaffold.model.python.evaluation.literals import string_pieces
from scaffold.model.python.module import PythonModule
from scaffold.record import NamedTuple
from scaffold.source import Location


class EntryPoint(NamedTuple):
    """An entry point such as ``talker = demo.talker:main``."""

    group: str
    """``console_scripts`` ..."""
    name: str
    module: str
    function: str
    """The function, dotted for an attribute of a class; empty without a colon."""
    text: str
    """The whole text; the other parts are empty if it is malformed."""
    location: Location
    node: ast.expr
    malformed: str | None = None
    """The error, if it is malformed."""
    joined: tuple[Location, ...] = ()
    """The locations of adjacent literals, if there are several: a comma may be missing."""


class EntryPointReader:
    """Reads the entry points in the expressions of a setup.py."""

    def __init__(self, module: PythonModule, evaluator: Evaluator) -> None:
        self._module = module
        self._evaluator = evaluator

    def of_group(self, group: str, node: ast.expr) -> Iterator[EntryPoint | None]:
        """Yield the entry points in the value of a group; ``None`` for unknown ones."""
        value = self._evaluator.evaluate(node)
        if isinstance(value, str):
            for text, at in self._lines_of(node, value):
                yield self._entry_point(group, text, at, node)
            return
        elements = self._evaluator.elements(node)
        for item in elements.items:
            at = self._module.location(item.node)
            if isinstance(item.value, str):
                yield self._entry_point(group, item.value, at, item.node)
            elif isinstance(item.node, ast.Tuple | ast.List):
                yield from self.of_group(group, item.node)  # setuptools flattens nested lists
            else:
                yield None
        if not elements.complete:
            yield None

    def of_option(self, group: IniOption, call: ast.expr) -> Iterator[EntryPoint]:
        """Yield the entry points of a group in setup.cfg."""
        for line in group.lines:
            yield self._entry_point(group.key, line.text, line.location, call)

    def of_text(self, node: ast.expr, value: str) -> Iterator[EntryPoint]:
        """Yield the entry points in a string that has the format of setup.cfg."""
        group = ""
        for text, at in self._lines_of(node, value):
            if text.startswith("[") and text.endswith("]"):
                group = text[1:-1].strip()
            else:
                yield self._entry_point(group, text, at, node)

    def _lines_of(self, node: ast.expr, value: str) -> Iterator[tuple[str, Location]]:
        """Yield the non-empty lines of a string, with their locations if known."""
        start, end = self._module.span(node)
        at = start
        for line in value.splitlines():
            text = line.strip()
            if not text or text.startswith("#"):
                continue
            begin = self._module.source.text.find(text, at, end)
            if begin >= 0:
                at = begin + len(text)
                yield text, self._module.source.location(begin, at)
            else:
                yield text, self._module.location(node)

    def _entry_point(self, group: str, text: str, at: Location, node: ast.expr) -> EntryPoint:
        name, equals, target = (part.strip() for part in text.partition("="))
        module, colon, function = (part.strip() for part in target.partition("[")[0].partition(":"))
        joined = self._joined_literals(node)
        problem = None
        if not name or not equals or not module:
            problem = "not of the form name = module:function"
        elif "=" in target or ":" in function or ":" in name:
            problem = "two entries run together"
        if problem:
            return EntryPoint(group, "", "", "", text, at, node, problem, joined)
        if not function and (colon or group in {"console_scripts", "gui_scripts"}):
            problem = "no function is named: name = module:function"
        elif not _is_importable(module) or not _is_dotted(function or "x"):
            problem = "module or function is not a Python name"
        return EntryPoint(group, name, module, function, text, at, node, problem, joined)

    def _joined_literals(self, node: ast.expr) -> tuple[Location, ...]:
        """Return the locations of the adjacent literals of a string."""
        if not isinstance(node, ast.Constant | ast.JoinedStr):
            return ()
        pieces = list(string_pieces(self._module, node))
        return tuple(self._module.source.location(*piece) for piece in pieces[1:] and pieces)


def _is_dotted(name: str) -> bool:
    return all(map(str.isidentifier, name.split(".")))


def _is_importable(module: str) -> bool:
    """Return whether an entry point can have a module, which is imported by a string.

    Unlike in an ``import`` statement, parts of the name may start with a digit.
    """
    return re.fullmatch(r"\w+(?:\.\w+)*", module) is not None
