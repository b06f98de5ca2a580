"""Expands the macros of a xacro file, as far as possible without arguments.

The values of arguments are unknown, so elements that depend on them may or may not exist; if an
included file cannot be read, undefined names are not reported.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING

from scaffold.formats.xml import Element
from scaffold.model.robot import expressions
from scaffold.model.robot.expressions import SHARE_MARK, UNKNOWN_MARK, is_known, unknown
from scaffold.model.robot.files import RobotFile, next_to, robot_file, source_of
from scaffold.model.robot.xacro.calls import Calls
from scaffold.model.robot.xacro.parts import Part, is_for_others
from scaffold.model.robot.xacro.problems import Problems
from scaffold.model.robot.xacro.scopes import Block, Frame, Lazy, Macro, Scope, parameters
from scaffold.model.robot.xacro.values import Values
from scaffold.source import ViewError

if TYPE_CHECKING:
    from scaffold.model.package import Package

_MAX_DEPTH = 40
_MAX_PARTS = 30_000
"""The maximum number of elements of a robot; the largest public one has 4 000."""
_UNPREFIXED = frozenset({"include", "macro", "property", "insert_block"})


class Expansion:
    """The expansion of a xacro file.

    Args:
        file: The file.
        package: The checked package; the file may include those of other packages.
        is_open: Whether names may be defined elsewhere.
    """

    def __init__(self, file: RobotFile, package: Package, *, is_open: bool = False) -> None:
        self.file = file
        self.root = Part(file.root.tag, file.root, file, is_certain=True)
        self.problems = Problems(file, package, is_open=is_open)
        self.files: set[tuple[str, str]] = set()
        """The included files, by package and path."""
        self.certain: set[int] = set()
        """The unconditional includes, by the identity of their elements."""
        self.patterns: list[str] = []
        """Regular expressions for names of files that may be included."""
        self.macros: set[int] = set()
        """The called macros, by the identity of their elements."""
        self._package = package
        self._values = Values(package, self.problems)
        self._calls = Calls(self._values, self.problems)
        self._arguments: set[str] = set()
        self._parts = 0

    @property
    def is_complete(self) -> bool:
        """Whether all parts are known."""
        return not self.problems.is_open and not self.problems.is_partial

    @property
    def arguments(self) -> frozenset[str]:
        """The names declared by ``<xacro:arg>``, also in included files."""
        return frozenset(self._arguments)

    def read(self) -> Expansion:
        """Expand the whole file."""
        frame = Frame(self.file, Scope(), {}, is_certain=True, depth=0)
        self._set_attributes(self.root, frame)
        self._contents(self.file.root, self.root, frame)
        for name, location in self._values.argument_uses:
            if name not in self._arguments:
                self.problems.note("argument", name, frame.file, location, tuple(self._arguments))
        return self

    def read_macro(self, macro: Element) -> Expansion:
        """Expand the body of a macro that is never called."""
        scope = Scope()
        for name in parameters(macro.get("params") or ""):
            scope.values[name] = unknown(name)
        frame = Frame(self.file, scope, {}, is_certain=False, depth=0)
        self._contents(macro, self.root, frame)
        return self

    # -- elements

    def _contents(self, element: Element, holder: Part, frame: Frame) -> None:
        self._parts += 1
        if frame.depth > _MAX_DEPTH or self._parts > _MAX_PARTS:
            self.problems.is_open = self.problems.is_partial = True
            return
        for item in element.content:
            if isinstance(item, Element):
                self._element(item, holder, frame)
            elif "$" in item.text:
                self._values.text(item.text, frame, lambda: element.text_location)

    def _element(self, element: Element, holder: Part, frame: Frame) -> None:
        if frame.file.is_xacro and element.tag.startswith("xacro:"):
            handler = _HANDLERS.get(element.tag)
            if handler is not None:
                handler(self, element, holder, frame)
            else:
                self._call(element.tag[6:], element, holder, frame)
            return
        macro = frame.macros.get(element.tag)
        is_macro = macro is not None and not macro.is_shorthand and not is_for_others(holder)
        if is_macro or (element.tag in _UNPREFIXED and holder is self.root):
            self.problems.note("tag", element.tag, frame.file, element.name_location, ())
        part = Part(element.tag, element, frame.file, holder, is_certain=frame.is_certain)
        self._set_attributes(part, frame)
        self._contents(element, part, frame)

    def _set_attributes(self, part: Part, frame: Frame) -> None:
        for attribute in part.element.attributes.values():
            part.attributes[attribute.name] = str(self._values.attribute(attribute, frame))

    # -- elements of xacro

    def _include(self, element: Element, holder: Part, frame: Frame) -> None:
        if frame.is_certain:
            self.certain.add(id(element))
        filename = self._values.of(element, "filename", frame)
        target = self._included(str(filename), frame)
        if target is None:
            self.problems.is_open = self.problems.is_partial = True
            return
        self.files.add((target.package.name, target.path))
        below = frame._replace(file=target, depth=frame.depth + 1)
        namespace = self._values.of(element, "ns", frame)
        if namespace and isinstance(namespace, str):
            below = below._replace(scope=Scope(frame.scope), macros=dict(frame.macros))
        self._contents(target.root, holder, below)
        if namespace:
            frame.scope.values[str(namespace)] = unknown(str(namespace))
            for name, macro in below.macros.items():
                if frame.macros.get(name) is not macro:
                    frame.macros[f"{namespace}.{name}"] = macro._replace(
                        scope=below.scope, macros=macro.macros or below.macros
                    )

    def _included(self, spec: str, frame: Frame) -> RobotFile | None:
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

    def _property(self, element: Element, _holder: Part, frame: Frame) -> None:
        name = str(self._values.of(element, "name", frame))
        value, default = element.attributes.get("value"), element.attributes.get("default")
        scope = frame.scope.target(element.get("scope"))
        given = value or default
        if value is None and default is not None and frame.scope.find(name) is not None:
            return
        if not frame.is_certain or not is_known(name):
            scope.values[name] = unknown(f"{name} at {element.start}")
            scope.values.setdefault(f"**{name}", Block(element, frame, is_content=True))
        elif given is not None:
            attribute = given
            scope.values[name] = Lazy(attribute.value, frame.file, lambda: attribute.location)
            if element.get("scope") or element.get("lazy_eval") == "false":
                scope.values[name] = self._values.literal(
                    attribute.value, frame, lambda: attribute.location
                )
        elif element.get("remove") is None:
            scope.values[f"**{name}"] = Block(element, frame, is_content=True)

    def _define(self, element: Element, _holder: Part, frame: Frame) -> None:
        name = (element.get("name") or "").removeprefix("xacro:")
        is_ambiguous = not frame.is_certain and name in frame.macros
        accepted = parameters(element.get("params") or "")
        frame.macros[name] = Macro(element, frame.file, accepted, None, is_ambiguous)

    def _argument(self, element: Element, _holder: Part, frame: Frame) -> None:
        self._arguments.add(element.get("name") or "")
        self._values.of(element, "default", frame)

    def _condition(self, element: Element, holder: Part, frame: Frame) -> None:
        value = self._values.of(element, "value", frame)
        try:
            keeps = expressions.truth(value)
        except ValueError:
            self.problems.misfit(
                "condition", element.tag, str(value), frame.file, element.attributes["value"]
            )
            keeps = None
        if keeps is None:
            self._contents(element, holder, frame._replace(is_certain=False))
        elif keeps is (element.tag == "xacro:if"):
            self._contents(element, holder, frame)

    def _insert(self, element: Element, holder: Part, frame: Frame) -> None:
        name = str(self._values.of(element, "name", frame))
        for key in (f"**{name}", f"*{name}"):
            scope = frame.scope.find(key)
            block = scope.values[key] if scope is not None else None
            if isinstance(block, Block):
                certain = frame.is_certain and block.frame.is_certain
                below = block.frame._replace(is_certain=certain, depth=frame.depth + 1)
                if block.is_content:
                    self._contents(block.element, holder, below)
                else:
                    self._element(block.element, holder, below)
                return
        self.problems.is_partial = True
        if not is_known(name) or frame.scope.find(name) is not None:
            return  # a property without a block, or the parameter of an uncalled macro
        at = element.attributes.get("name")
        location = at.location if at is not None else element.name_location
        self.problems.note("block", name, frame.file, location, ())

    def _set_attribute(self, element: Element, holder: Part, frame: Frame) -> None:
        name = str(self._values.of(element, "name", frame))
        holder.attributes[name] = str(self._values.of(element, "value", frame))

    def _make_part(self, element: Element, holder: Part, frame: Frame) -> None:
        tag = str(self._values.of(element, "xacro:name", frame))
        part = Part(tag, element, frame.file, holder, is_certain=frame.is_certain)
        self._set_attributes(part, frame)
        self._contents(element, part, frame)

    def _call_dynamic(self, element: Element, holder: Part, frame: Frame) -> None:
        name = str(self._values.of(element, "macro", frame))
        if is_known(name):
            self._call(name, element, holder, frame)
        else:
            self.problems.is_partial = True

    def _call(self, name: str, element: Element, holder: Part, frame: Frame) -> None:
        macro = frame.macros.get(name)
        if macro is None:
            self.problems.is_partial = True
            is_plain = not element.attributes and not element.children
            kind = "stop" if is_plain and not frame.is_certain else "macro"
            self.problems.note(kind, name, frame.file, element.name_location, tuple(frame.macros))
            return
        self.macros.add(id(macro.element))
        scope = None if macro.is_ambiguous else self._calls.bind(name, macro, element, frame)
        if scope is None:
            self.problems.is_partial = True
            return
        below = frame._replace(
            file=macro.file,
            scope=scope,
            macros=dict(frame.macros if macro.macros is None else macro.macros),
            depth=frame.depth + 1,
        )
        self._contents(macro.element, holder, below)


_Handler = Callable[[Expansion, Element, Part, Frame], None]
_HANDLERS: Mapping[str, _Handler] = {
    "xacro:include": Expansion._include,  # noqa: SLF001  a table of the class itself
    "xacro:property": Expansion._property,  # noqa: SLF001
    "xacro:macro": Expansion._define,  # noqa: SLF001
    "xacro:arg": Expansion._argument,  # noqa: SLF001
    "xacro:if": Expansion._condition,  # noqa: SLF001
    "xacro:unless": Expansion._condition,  # noqa: SLF001
    "xacro:insert_block": Expansion._insert,  # noqa: SLF001
    "xacro:attribute": Expansion._set_attribute,  # noqa: SLF001
    "xacro:element": Expansion._make_part,  # noqa: SLF001
    "xacro:call": Expansion._call_dynamic,  # noqa: SLF001
}


def _read(package: Package, path: str) -> RobotFile | None:
    try:
        return robot_file(package, path)
    except ViewError:
        return None
