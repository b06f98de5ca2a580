"""The values of texts after xacro has evaluated expressions and substitutions."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from scaffold.model.robot import expressions
from scaffold.model.robot.expressions import (
    BUILT_IN,
    COMMANDS,
    SHARE_MARK,
    NotKnownError,
    Value,
    is_known,
    unknown,
)
from scaffold.model.robot.xacro.scopes import Block, Frame, Lazy, Scope

if TYPE_CHECKING:
    from scaffold.formats.xml import Attribute, Element
    from scaffold.model.package import Package
    from scaffold.model.robot.xacro.problems import Problems
    from scaffold.source import Location


class Values:
    """Evaluates texts of xacro.

    Args:
        package: What is reported on.
        problems: Receives undefined names.
    """

    def __init__(self, package: Package, problems: Problems) -> None:
        self.argument_uses: list[tuple[str, Location]] = []
        """The arguments used by the files of the package, with locations."""
        self._package = package
        self._problems = problems
        self._resolving: set[tuple[int, str]] = set()

    def attribute(self, attribute: Attribute, frame: Frame) -> Value:
        """Return the value of an attribute."""
        return self.text(attribute.value, frame, lambda: attribute.location)

    def of(self, element: Element, name: str, frame: Frame) -> Value:
        """Return the value of an attribute of an element; empty without it."""
        attribute = element.attributes.get(name)
        return "" if attribute is None else self.attribute(attribute, frame)

    def literal(self, text: str, frame: Frame, place: Callable[[], Location]) -> Value:
        """Return the value of a text in a property or a parameter."""
        value = self.text(text, frame, place)
        return expressions.literal(value) if isinstance(value, str) else value

    def text(self, text: str, frame: Frame, place: Callable[[], Location]) -> Value:
        """Return a text after evaluation."""
        if "$" not in text:
            return text
        if not frame.file.is_xacro:
            return unknown(text)
        results: list[Value] = []
        for token in expressions.tokens(text):
            if token.startswith("$$") and token[-1] in "{(":
                results.append(token[1:])
            elif token.startswith("${"):
                results.append(self._expression(token[2:-1], frame, place))
            elif token.startswith("$("):
                results.append(self._command(token[2:-1], frame, place))
            else:
                results.append(token)
        return results[0] if len(results) == 1 else "".join(map(str, results))

    def _expression(self, text: str, frame: Frame, place: Callable[[], Location]) -> Value:
        inner = str(self.text(text, frame, place)) if "$" in text else text
        if not is_known(inner) or SHARE_MARK in inner:
            return unknown(inner)
        try:
            names = expressions.names_in(inner)
        except (SyntaxError, ValueError, RecursionError):
            self._problems.note("expression", inner, frame.file, place(), ())
            return unknown(inner)
        used: list[str] = []
        for name in names:
            scope = frame.scope.find(name)
            if scope is not None:
                used.append(f"{name}={self.resolved(name, scope, frame)}")
            elif name not in BUILT_IN:
                self._problems.note("property", name, frame.file, place(), frame.scope.names)
                return unknown(inner)
        try:
            return expressions.evaluate(inner, lambda name: self._looked_up(name, frame))
        except NotKnownError:
            scope = frame.scope.find(inner.strip())
            value = self.resolved(inner.strip(), scope, frame) if scope is not None else ""
            if isinstance(value, str) and value:
                return value  # what is known of it stays so
            return unknown(f"{inner} {' '.join(used)}")

    def _looked_up(self, name: str, frame: Frame) -> Value:
        scope = frame.scope.find(name)
        if scope is None:
            raise NotKnownError
        value = self.resolved(name, scope, frame)
        if value == "" and name not in scope.values:
            raise NotKnownError
        return value

    def resolved(self, name: str, scope: Scope, frame: Frame) -> Value:
        """Return the value of a property, which is evaluated at its first use."""
        value = scope.values[name]
        if isinstance(value, Block):
            return unknown(name)
        if not isinstance(value, Lazy):
            return value
        key = (id(scope), name)
        if key in self._resolving:
            return unknown(name)
        self._resolving.add(key)
        result = self.literal(value.text, frame._replace(file=value.file), value.place)
        self._resolving.discard(key)
        scope.values[name] = result
        return result

    def _command(self, text: str, frame: Frame, place: Callable[[], Location]) -> Value:
        inner = str(self.text(text, frame, place)) if "$" in text else text
        command, _, rest = inner.strip().partition(" ")
        rest = rest.strip()
        if command == "find" and is_known(rest):
            return f"{SHARE_MARK}{rest}{SHARE_MARK}"
        if command == "arg" and is_known(rest):
            if frame.file.package is self._package:
                self.argument_uses.append((rest, place()))
        elif command not in COMMANDS and is_known(command):
            self._problems.note("command", command, frame.file, place(), COMMANDS)
        return unknown(inner)
