"""What xacro makes of a file: its elements after all macros, as far as that is known.

Arguments are not known here, so what depends on them may be there or not; a file that cannot be
included leaves names open.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping
from typing import TYPE_CHECKING

from scaffold.formats.xml import Attribute, Element
from scaffold.model.robot import expressions
from scaffold.model.robot.expressions import (
    BUILT_IN,
    COMMANDS,
    SHARE_MARK,
    UNKNOWN_MARK,
    NotKnownError,
    Value,
    is_known,
    unknown,
)
from scaffold.model.robot.files import RobotFile, next_to, robot_file, source_of
from scaffold.record import NamedTuple
from scaffold.source import Location, ViewError

if TYPE_CHECKING:
    from scaffold.model.package import Package

_MOST_DEPTH = 40
_MOST_PARTS = 30_000
"""Elements of one robot; the largest of the public ones has 4 000."""
_EXPRESSION = r"\$\{[^}]{0,900}\}|\$\([^)]{0,900}\)"
_DEFAULT = rf"(?:{_EXPRESSION}|'[^']*'(?:'(?=\s|$))?|\"[^\"]*\"|(?!{_EXPRESSION})[^\s'\"])*"
_PARAMETER = re.compile(rf"\s*([^\s:=]+)\s*:?=\s*(\^\|?)?({_DEFAULT})(?=\s|$)")
_PARAMETER_NAME = re.compile(r"\s*(\S+)")
_UNPREFIXED = frozenset({"include", "macro", "property", "insert_block"})
NOT_URDF = frozenset({"gazebo", "ros2_control", "transmission", "sensor", "plugin", "sdf"})
"""Elements whose contents others read."""


class Part:
    """An element of what xacro writes."""

    __slots__ = ("attributes", "children", "element", "file", "holder", "is_certain", "tag")

    def __init__(
        self,
        tag: str,
        element: Element,
        file: RobotFile,
        holder: Part | None = None,
        *,
        is_certain: bool,
    ) -> None:
        self.tag = tag
        self.holder = holder
        self.element = element
        self.file = file
        self.is_certain = is_certain
        """Whether it is there with any arguments."""
        self.attributes: dict[str, str] = {}
        """Unknown parts of a value are between two ``UNKNOWN_MARK``."""
        self.children: list[Part] = []
        if holder is not None:
            holder.children.append(self)

    def get(self, name: str) -> str | None:
        """Return an attribute."""
        return self.attributes.get(name)

    def all(self, tag: str) -> list[Part]:
        """Return the children with a tag."""
        return [child for child in self.children if child.tag == tag]

    def one(self, tag: str) -> Part | None:
        """Return the first child with a tag."""
        return next(iter(self.all(tag)), None)

    def at(self, name: str) -> Location:
        """Return the place of the value of an attribute; of the tag, if there is none."""
        attribute = self.element.attributes.get(name)
        return attribute.location if attribute is not None else self.location

    @property
    def location(self) -> Location:
        """The place of the tag."""
        return self.element.name_location

    def descendants(self) -> Iterator[Part]:
        """Yield all parts inside."""
        pending = [*reversed(self.children)]
        while pending:
            part = pending.pop()
            yield part
            pending += reversed(part.children)


class Undefined(NamedTuple):
    """A name that nothing defines."""

    kind: str
    """``macro``, ``property``, ``block``, ``argument``, ``command``, ``expression`` or ``tag``."""
    name: str
    location: Location
    known: tuple[str, ...]
    """The names that are defined there."""


class Misfit(NamedTuple):
    """A call that does not fit the macro."""

    kind: str
    """``unknown``, ``missing``, ``block missing``, ``block unused`` or ``condition``."""
    macro: str
    name: str
    location: Location
    known: tuple[str, ...]


class NamedFile(NamedTuple):
    """A file that another one names."""

    package: str
    """The package whose share directory it is in; empty if the path is relative to a file."""
    path: str
    """Relative to that directory, or to the package."""
    user: str
    """The path of the file that names it."""
    location: Location


def _is_for_others(part: Part | None) -> bool:
    """Tell whether an element or one around it is read by others than urdfdom."""
    while part is not None and part.tag not in NOT_URDF:
        part = part.holder
    return part is not None


class _Macro(NamedTuple):
    element: Element
    file: RobotFile
    parameters: dict[str, tuple[bool, str | None] | None]
    """``None`` without a default; else whether the caller's value is taken, and the default."""
    scope: _Scope | None
    is_ambiguous: bool
    macros: dict[str, _Macro] | None = None
    """What its body can call, where it was included with a namespace."""


class _Lazy(NamedTuple):
    """The value of a property, evaluated where it is used."""

    text: str
    file: RobotFile
    place: Callable[[], Location]


class _Block(NamedTuple):
    element: Element
    frame: _Frame
    is_content: bool


class _Scope:
    """Properties, and those around them."""

    __slots__ = ("_parent", "values")

    def __init__(self, parent: _Scope | None = None) -> None:
        self._parent = parent
        self.values: dict[str, Value | _Lazy | _Block] = {}

    def find(self, name: str) -> _Scope | None:
        scope: _Scope | None = self
        while scope is not None:
            if name in scope.values:
                return scope
            scope = scope._parent  # noqa: SLF001  of its own class
        return None

    def target(self, which: str | None) -> _Scope:
        """Return the scope that ``scope="global"`` or ``"parent"`` means."""
        if which == "parent":
            return self._parent or self
        scope = self
        while which == "global" and scope._parent is not None:
            scope = scope._parent
        return scope

    @property
    def names(self) -> tuple[str, ...]:
        names = [name for name in self.values if not name.startswith("*")]
        return (*names, *(self._parent.names if self._parent is not None else ()))


class _Frame(NamedTuple):
    """Where the reader is."""

    file: RobotFile
    scope: _Scope
    macros: dict[str, _Macro]
    is_certain: bool
    depth: int


class Expansion:
    """What xacro makes of a file.

    Args:
        file: The file.
        package: What is reported on; the file may include those of other packages.
        is_open: Names may be defined elsewhere.
    """

    def __init__(self, file: RobotFile, package: Package, *, is_open: bool = False) -> None:
        self.file = file
        self.root = Part(file.root.tag, file.root, file, is_certain=True)
        self.undefined: list[Undefined] = []
        self.misfits: list[Misfit] = []
        self.files: set[tuple[str, str]] = set()
        """The files that are included, by package and path."""
        self.patterns: list[str] = []
        """Regular expressions of the names of files that may be included."""
        self.macros: set[int] = set()
        """The macros that are called, by the identity of their elements."""
        self.is_open = is_open
        """Whether a file is included that is not known."""
        self.is_partial = False
        """Whether parts are missing, or may be."""
        self._package = package
        self._arguments: set[str] = set()
        self._argument_uses: list[tuple[str, Location]] = []
        self._parts = 0
        self._resolving: set[tuple[int, str]] = set()

    def read(self) -> Expansion:
        """Expand the whole file."""
        frame = _Frame(self.file, _Scope(), {}, is_certain=True, depth=0)
        self._set_attributes(self.root, frame)
        self._contents(self.file.root, self.root, frame)
        for name, location in self._argument_uses:
            if name not in self._arguments:
                self._note("argument", name, frame, location, tuple(self._arguments))
        return self

    def read_macro(self, macro: Element) -> Expansion:
        """Expand the body of a macro that nobody calls."""
        scope = _Scope()
        for name in _parameters(macro.get("params") or ""):
            scope.values[name] = unknown(name)
        frame = _Frame(self.file, scope, {}, is_certain=False, depth=0)
        self._contents(macro, self.root, frame)
        return self

    # -- elements

    def _contents(self, element: Element, holder: Part, frame: _Frame) -> None:
        self._parts += 1
        if frame.depth > _MOST_DEPTH or self._parts > _MOST_PARTS:
            self.is_open = self.is_partial = True
            return
        for item in element.content:
            if isinstance(item, Element):
                self._element(item, holder, frame)
            elif "$" in item.text:
                self._text(item.text, frame, lambda: element.text_location)

    def _element(self, element: Element, holder: Part, frame: _Frame) -> None:
        if frame.file.is_xacro and element.tag.startswith("xacro:"):
            handler = _HANDLERS.get(element.tag)
            if handler is not None:
                handler(self, element, holder, frame)
            else:
                self._call(element.tag[6:], element, holder, frame)
            return
        is_macro = element.tag in frame.macros and not _is_for_others(holder)
        if is_macro or (element.tag in _UNPREFIXED and holder is self.root):
            self._note("tag", element.tag, frame, element.name_location, ())
        part = Part(element.tag, element, frame.file, holder, is_certain=frame.is_certain)
        self._set_attributes(part, frame)
        self._contents(element, part, frame)

    def _set_attributes(self, part: Part, frame: _Frame) -> None:
        for attribute in part.element.attributes.values():
            part.attributes[attribute.name] = str(self._attribute(attribute, frame))

    def _attribute(self, attribute: Attribute, frame: _Frame) -> Value:
        return self._text(attribute.value, frame, lambda: attribute.location)

    def _value(self, element: Element, name: str, frame: _Frame) -> Value:
        attribute = element.attributes.get(name)
        return "" if attribute is None else self._attribute(attribute, frame)

    # -- what xacro handles

    def _include(self, element: Element, holder: Part, frame: _Frame) -> None:
        filename = self._value(element, "filename", frame)
        target = self._included(str(filename), frame)
        if target is None:
            self.is_open = self.is_partial = True
            return
        self.files.add((target.package.name, target.path))
        below = frame._replace(file=target, depth=frame.depth + 1)
        namespace = self._value(element, "ns", frame)
        if namespace and isinstance(namespace, str):
            below = below._replace(scope=_Scope(frame.scope), macros=dict(frame.macros))
        self._contents(target.root, holder, below)
        if namespace:
            frame.scope.values[str(namespace)] = unknown(str(namespace))
            for name, macro in below.macros.items():
                if frame.macros.get(name) is not macro:
                    frame.macros[f"{namespace}.{name}"] = macro._replace(
                        scope=below.scope, macros=macro.macros or below.macros
                    )

    def _included(self, spec: str, frame: _Frame) -> RobotFile | None:
        user = frame.file
        if not is_known(spec) or not {"*", "?", "["}.isdisjoint(spec):
            name = re.sub(f"{UNKNOWN_MARK}[^{UNKNOWN_MARK}]*{UNKNOWN_MARK}", UNKNOWN_MARK, spec)
            name = name.rpartition("/")[2]
            self.patterns.append(re.sub(rf"{UNKNOWN_MARK}|\\[*?]", ".*", re.escape(name)))
            return None
        named = re.fullmatch(f"{SHARE_MARK}([^{SHARE_MARK}]+){SHARE_MARK}/+(.*)", spec)
        if named is not None:
            package = user.package
            if named[1] != package.name:
                other = self._package.workspace.get(named[1])
                if other is None:
                    return None
                package = other
            return _read(package, source_of(package, named[2]))
        if not spec or spec.startswith("/") or SHARE_MARK in spec:
            return None
        path = next_to(user.path, spec)
        return _read(user.package, path)

    def _property(self, element: Element, _holder: Part, frame: _Frame) -> None:
        name = str(self._value(element, "name", frame))
        value, default = element.attributes.get("value"), element.attributes.get("default")
        scope = frame.scope.target(element.get("scope"))
        given = value or default
        if value is None and default is not None and frame.scope.find(name) is not None:
            return
        if not frame.is_certain or not is_known(name):
            scope.values[name] = unknown(f"{name} at {element.start}")
            scope.values.setdefault(f"**{name}", _Block(element, frame, is_content=True))
        elif given is not None:
            attribute = given
            scope.values[name] = _Lazy(attribute.value, frame.file, lambda: attribute.location)
            if element.get("scope") or element.get("lazy_eval") == "false":
                scope.values[name] = self._literal(
                    attribute.value, frame, lambda: attribute.location
                )
        elif element.get("remove") is None:
            scope.values[f"**{name}"] = _Block(element, frame, is_content=True)

    def _define(self, element: Element, _holder: Part, frame: _Frame) -> None:
        name = (element.get("name") or "").removeprefix("xacro:")
        is_ambiguous = not frame.is_certain and name in frame.macros
        parameters = _parameters(element.get("params") or "")
        frame.macros[name] = _Macro(element, frame.file, parameters, None, is_ambiguous)

    def _argument(self, element: Element, _holder: Part, frame: _Frame) -> None:
        self._arguments.add(element.get("name") or "")
        self._value(element, "default", frame)

    def _condition(self, element: Element, holder: Part, frame: _Frame) -> None:
        value = self._value(element, "value", frame)
        try:
            keeps = expressions.truth(value)
        except ValueError:
            self._misfit("condition", element.tag, str(value), frame, element.attributes["value"])
            keeps = None
        if keeps is None:
            self._contents(element, holder, frame._replace(is_certain=False))
        elif keeps is (element.tag == "xacro:if"):
            self._contents(element, holder, frame)

    def _insert(self, element: Element, holder: Part, frame: _Frame) -> None:
        name = str(self._value(element, "name", frame))
        for key in (f"**{name}", f"*{name}"):
            scope = frame.scope.find(key)
            block = scope.values[key] if scope is not None else None
            if isinstance(block, _Block):
                certain = frame.is_certain and block.frame.is_certain
                below = block.frame._replace(is_certain=certain, depth=frame.depth + 1)
                if block.is_content:
                    self._contents(block.element, holder, below)
                else:
                    self._element(block.element, holder, below)
                return
        self.is_partial = True
        if not is_known(name) or frame.scope.find(name) is not None:
            return  # a property without a block, or the parameter of a macro that nobody calls
        at = element.attributes.get("name")
        location = at.location if at is not None else element.name_location
        self._note("block", name, frame, location, ())

    def _set_attribute(self, element: Element, holder: Part, frame: _Frame) -> None:
        name = str(self._value(element, "name", frame))
        holder.attributes[name] = str(self._value(element, "value", frame))

    def _make(self, element: Element, holder: Part, frame: _Frame) -> None:
        tag = str(self._value(element, "xacro:name", frame))
        part = Part(tag, element, frame.file, holder, is_certain=frame.is_certain)
        self._set_attributes(part, frame)
        self._contents(element, part, frame)

    def _call_dynamic(self, element: Element, holder: Part, frame: _Frame) -> None:
        name = str(self._value(element, "macro", frame))
        if is_known(name):
            self._call(name, element, holder, frame)
        else:
            self.is_partial = True

    def _call(self, name: str, element: Element, holder: Part, frame: _Frame) -> None:
        macro = frame.macros.get(name)
        if macro is None:
            self.is_partial = True
            self._note("macro", name, frame, element.name_location, tuple(frame.macros))
            return
        self.macros.add(id(macro.element))
        scope = None if macro.is_ambiguous else self._bound(name, macro, element, frame)
        if scope is None:
            self.is_partial = True
            return
        below = frame._replace(
            file=macro.file,
            scope=scope,
            macros=dict(frame.macros if macro.macros is None else macro.macros),
            depth=frame.depth + 1,
        )
        self._contents(macro.element, holder, below)

    def _bound(self, name: str, macro: _Macro, element: Element, frame: _Frame) -> _Scope | None:
        """Return the parameters of a call; ``None`` if it does not fit."""
        scope = _Scope(macro.scope or frame.scope)
        known = tuple(item for item in macro.parameters if not item.startswith("*"))
        given = element.attributes
        if element.tag == "xacro:call":
            given.pop("macro", None)
        before = len(self.misfits)
        for attribute in given.values():
            if attribute.name in macro.parameters:
                scope.values[attribute.name] = self._literal(
                    attribute.value,
                    frame,
                    lambda at=attribute: at.location,  # type: ignore[misc]
                )
            elif ":" not in attribute.name and attribute.name != "xmlns":
                place = attribute._replace(location=attribute.name_location)
                self._misfit("unknown", name, attribute.name, frame, place, known)
        self._bind_blocks(name, macro, element, frame, scope)
        for parameter, default in macro.parameters.items():
            if parameter in scope.values or parameter.startswith("*"):
                continue
            value = self._default(parameter, default, macro, frame)
            if value is None:
                self._misfit("missing", name, parameter, frame, element, known)
            else:
                scope.values[parameter] = value
        return scope if len(self.misfits) == before else None

    def _bind_blocks(
        self, name: str, macro: _Macro, element: Element, frame: _Frame, scope: _Scope
    ) -> None:
        blocks = element.children
        wanted = [item for item in macro.parameters if item.startswith("*")]
        if any(block.tag.startswith("xacro:") for block in blocks):
            self.is_partial = self.is_partial or len(blocks) != len(wanted)
        elif len(blocks) < len(wanted):
            missing = wanted[len(blocks)].lstrip("*")
            self._misfit("block missing", name, missing, frame, element)
        elif len(blocks) > len(wanted):
            extra = blocks[len(wanted)]
            self._misfit("block unused", name, extra.tag, frame, extra)
        for parameter in wanted:
            if blocks:
                block, *blocks = blocks
                is_content = parameter.startswith("**")
                scope.values[parameter] = _Block(block, frame, is_content)
            else:
                scope.values[parameter.lstrip("*")] = unknown(parameter)

    def _default(
        self,
        name: str,
        default: tuple[bool, str | None] | None,
        macro: _Macro,
        frame: _Frame,
    ) -> Value | None:
        if default is None:
            return None
        is_forwarded, text = default
        if is_forwarded:
            scope = frame.scope.find(name)
            if scope is not None:
                return self._resolved(name, scope, frame)
        if text is None:
            return unknown(name) if is_forwarded and self.is_open else None
        return self._literal(text, frame, lambda: macro.element.name_location)

    # -- text

    def _literal(self, text: str, frame: _Frame, place: Callable[[], Location]) -> Value:
        value = self._text(text, frame, place)
        return expressions.literal(value) if isinstance(value, str) else value

    def _text(self, text: str, frame: _Frame, place: Callable[[], Location]) -> Value:
        """Return what a text is after evaluation."""
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

    def _expression(self, text: str, frame: _Frame, place: Callable[[], Location]) -> Value:
        inner = str(self._text(text, frame, place)) if "$" in text else text
        if not is_known(inner) or SHARE_MARK in inner:
            return unknown(inner)
        try:
            names = expressions.names_in(inner)
        except (SyntaxError, ValueError, RecursionError):
            self._note("expression", inner, frame, place(), ())
            return unknown(inner)
        used: list[str] = []
        for name in names:
            scope = frame.scope.find(name)
            if scope is not None:
                used.append(f"{name}={self._resolved(name, scope, frame)}")
            elif name not in BUILT_IN:
                self._note("property", name, frame, place(), frame.scope.names)
                return unknown(inner)
        try:
            return expressions.evaluate(inner, lambda name: self._looked_up(name, frame))
        except NotKnownError:
            return unknown(f"{inner} {' '.join(used)}")

    def _looked_up(self, name: str, frame: _Frame) -> Value:
        scope = frame.scope.find(name)
        if scope is None:
            raise NotKnownError
        value = self._resolved(name, scope, frame)
        if value == "" and name not in scope.values:
            raise NotKnownError
        return value

    def _resolved(self, name: str, scope: _Scope, frame: _Frame) -> Value:
        """Return the value of a property, which is evaluated at its first use."""
        value = scope.values[name]
        if isinstance(value, _Block):
            return unknown(name)
        if not isinstance(value, _Lazy):
            return value
        key = (id(scope), name)
        if key in self._resolving:
            return unknown(name)
        self._resolving.add(key)
        result = self._literal(value.text, frame._replace(file=value.file), value.place)
        self._resolving.discard(key)
        scope.values[name] = result
        return result

    def _command(self, text: str, frame: _Frame, place: Callable[[], Location]) -> Value:
        inner = str(self._text(text, frame, place)) if "$" in text else text
        command, _, rest = inner.strip().partition(" ")
        rest = rest.strip()
        if command == "find" and is_known(rest):
            return f"{SHARE_MARK}{rest}{SHARE_MARK}"
        if command == "arg" and is_known(rest):
            if frame.file.package is self._package:
                self._argument_uses.append((rest, place()))
        elif command not in COMMANDS and is_known(command):
            self._note("command", command, frame, place(), COMMANDS)
        return unknown(inner)

    # -- findings

    def _note(
        self, kind: str, name: str, frame: _Frame, location: Location, known: tuple[str, ...]
    ) -> None:
        is_ours = frame.file.package is self._package and frame.file.is_xacro
        if is_ours and not self.is_open and self.file.is_xacro:
            self.undefined.append(Undefined(kind, name, location, known))

    def _misfit(
        self,
        kind: str,
        macro: str,
        name: str,
        frame: _Frame,
        at: Attribute | Element,
        known: tuple[str, ...] = (),
    ) -> None:
        if frame.file.package is self._package:
            place = at.name_location if isinstance(at, Element) else at.location
            self.misfits.append(Misfit(kind, macro, name, place, known))
        else:
            self.is_partial = True


_Handler = Callable[[Expansion, Element, Part, _Frame], None]
_HANDLERS: Mapping[str, _Handler] = {
    "xacro:include": Expansion._include,  # noqa: SLF001  a table of the class itself
    "xacro:property": Expansion._property,  # noqa: SLF001
    "xacro:macro": Expansion._define,  # noqa: SLF001
    "xacro:arg": Expansion._argument,  # noqa: SLF001
    "xacro:if": Expansion._condition,  # noqa: SLF001
    "xacro:unless": Expansion._condition,  # noqa: SLF001
    "xacro:insert_block": Expansion._insert,  # noqa: SLF001
    "xacro:attribute": Expansion._set_attribute,  # noqa: SLF001
    "xacro:element": Expansion._make,
    "xacro:call": Expansion._call_dynamic,  # noqa: SLF001
}


def _parameters(text: str) -> dict[str, tuple[bool, str | None] | None]:
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


def _read(package: Package, path: str) -> RobotFile | None:
    try:
        return robot_file(package, path)
    except ViewError:
        return None
