"""Scopes of xacro: macros, properties and blocks by name."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from scaffold import lazy_re
from scaffold.record import NamedTuple

if TYPE_CHECKING:
    from scaffold.formats.xml import Element
    from scaffold.model.robot.expressions import Value
    from scaffold.model.robot.files import RobotFile
    from scaffold.source import Location

_EXPRESSION = r"\$\{[^}]{0,900}\}|\$\([^)]{0,900}\)"
_DEFAULT = rf"(?:{_EXPRESSION}|'[^']*'(?:'(?=\s|$))?|\"[^\"]*\"|(?!{_EXPRESSION})[^\s'\"])*"
_PARAMETER = lazy_re.compile(rf"\s*([^\s:=]+)\s*:?=\s*(\^\|?)?({_DEFAULT})(?=\s|$)")
_PARAMETER_NAME = lazy_re.compile(r"\s*(\S+)")


class Macro(NamedTuple):
    """The body of a macro, and the scope of its names."""

    element: Element
    file: RobotFile
    parameters: dict[str, tuple[bool, str | None] | None]
    """``None`` without a default; else whether the caller's value is used, and the default."""
    scope: Scope | None
    is_ambiguous: bool
    macros: dict[str, Macro] | None = None
    """The macros that its body can call, if included with a namespace."""

    @property
    def is_shorthand(self) -> bool:
        """Whether it writes an element of its own name, which is no call of it then."""
        name = (self.element.get("name") or "").removeprefix("xacro:")
        return any(part.tag == name for part in self.element.descendants())


class Lazy(NamedTuple):
    """The value of a property, evaluated where it is used."""

    text: str
    file: RobotFile
    place: Callable[[], Location]


class Block(NamedTuple):
    """Elements passed by a call or in a property, expanded where they are inserted."""

    element: Element
    frame: Frame
    is_content: bool


class Scope:
    """Properties, and the enclosing scope."""

    __slots__ = ("_parent", "values")

    def __init__(self, parent: Scope | None = None) -> None:
        self._parent = parent
        self.values: dict[str, Value | Lazy | Block] = {}

    def find(self, name: str) -> Scope | None:
        """Return the innermost scope with a name."""
        scope: Scope | None = self
        while scope is not None:
            if name in scope.values:
                return scope
            scope = scope._parent  # noqa: SLF001  of its own class
        return None

    def target(self, which: str | None) -> Scope:
        """Return the scope of ``scope="global"`` or ``"parent"``."""
        if which == "parent":
            return self._parent or self
        scope = self
        while which == "global" and scope._parent is not None:
            scope = scope._parent
        return scope

    @property
    def names(self) -> tuple[str, ...]:
        """All visible properties."""
        names = [name for name in self.values if not name.startswith("*")]
        return (*names, *(self._parent.names if self._parent is not None else ()))


class Frame(NamedTuple):
    """The position of the expansion."""

    file: RobotFile
    scope: Scope
    macros: dict[str, Macro]
    is_certain: bool
    depth: int


def parameters(text: str) -> dict[str, tuple[bool, str | None] | None]:
    """Return the parameters of a macro: ``x y:=1 z:=^|2 *block``."""
    result: dict[str, tuple[bool, str | None] | None] = {}
    position = 0
    while True:
        match = _PARAMETER.match(text, position)
        if match is not None:
            result[match[1]] = (match[2] is not None, match[3] or None)
        elif (match := _PARAMETER_NAME.match(text, position)) is not None:
            result[match[1]] = None
        else:
            return result
        position = match.end()
