"""Renders stubs of messages, services and actions from their definitions.

Each interface has a private module, as in generated code (``std_msgs/msg/_string.pyi``), which the
public module of its kind exports, so that a type checker reads only the interfaces that a program
uses.
"""

from __future__ import annotations

import keyword
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING

from scaffold.model.interfaces.syntax import Constant, Field, Section
from scaffold.model.interfaces.types import FLOATS, INTEGER_RANGES, TEXTS, FieldType, Value
from scaffold.record import NamedTuple

if TYPE_CHECKING:
    from scaffold.model.interfaces.definitions import Definitions, Interface

BASE_MODULE = "_ros_interfaces"
"""The stub with the definitions that all interfaces share; a program cannot import it."""
_KINDS = ("msg", "srv", "action")
_CODES = {
    "float32": "float32",
    "float64": "float64",
    "char": "uint8",
    **{name: name for name in INTEGER_RANGES if name not in {"byte", "char"}},
}
"""The element types of Python and NumPy arrays, by field type."""
_TIME = FieldType("Time", "builtin_interfaces")
_UUID = FieldType("UUID", "unique_identifier_msgs")
_EVENT_INFO = FieldType("ServiceEventInfo", "service_msgs")


def package_stubs(
    definitions: Definitions, package: str, *, others: bool = False
) -> dict[str, str]:
    """Return the stubs of all interfaces of a package, by relative path.

    An interface that cannot be read, or a package that may have more interfaces than are
    visible, gets stubs that allow any name, of any type.

    Args:
        definitions: The known interface definitions.
        package: The name of the package.
        others: Whether unknown messages are assumed to belong to another package,
            which has its own stubs; otherwise fields of such a type are ``Any``.
    """
    files: dict[str, str] = {}
    for kind in _KINDS:
        names = definitions.names(package, kind)
        if names is None:
            files[f"{package}/{kind}/__init__.pyi"] = _OPEN_MODULE
            continue
        exports = []
        for name in names:
            interface = definitions.find(f"{package}/{kind}/{name}")
            if interface is None:
                exports.append(f"{name}: Any")
                continue
            module = module_name(name)
            renderer = _Renderer(interface, definitions, others=others)
            files[f"{package}/{kind}/{module}.pyi"] = renderer.text()
            exports += [
                f"from {package}.{kind}.{module} import {part} as {part}"
                for part in renderer.exports
            ]
        if names:
            files[f"{package}/{kind}/__init__.pyi"] = _exporting(exports)
    if files:
        files[f"{package}/__init__.pyi"] = ""
    return files


_OPEN_MODULE = "from typing import Any\n\ndef __getattr__(name: str) -> Any: ...\n"


def _exporting(exports: Sequence[str]) -> str:
    head = "from typing import Any\n" if any(line.endswith(": Any") for line in exports) else ""
    return head + "".join(f"{line}\n" for line in exports)


def module_name(name: str) -> str:
    """Return the private module that defines an interface."""
    words = re.sub("(.)([A-Z][a-z]+)", r"\1_\2", name)
    return "_" + re.sub("([a-z0-9])([A-Z])", r"\1_\2", words).lower()


class _Member(NamedTuple):
    """A field of a class: the type when read, and the type when assigned."""

    name: str
    read: str
    written: str


class _Class(NamedTuple):
    """A class of a stub."""

    name: str
    base: str
    constants: Sequence[Constant]
    fields: Sequence[tuple[str, FieldType]]
    inside: Mapping[str, str]
    """The nested classes."""
    implementation: Mapping[str, str] = {}
    """The nested classes of its class ``Impl``."""


class _Renderer:
    """Renders an interface; collects the imports that its classes need."""

    def __init__(self, interface: Interface, definitions: Definitions, *, others: bool) -> None:
        self._interface = interface
        self._definitions = definitions
        self._others = others
        self._imports: set[str] = set()
        self._aliases: dict[str, str] = {}
        self._builtins = ""

    @property
    def exports(self) -> list[str]:
        """The names that the public module exports; the parts are exported for services only."""
        name, kind = self._interface.name, self._interface.kind
        services = [f"{name}_SendGoal", f"{name}_GetResult"] if kind == "action" else []
        services += [name] if kind == "srv" else []
        parts = ("Event", "Request", "Response")
        return [name, *(f"{service}_{part}" for service in services for part in parts)]

    def text(self) -> str:
        """Return the stub of the module that defines the interface."""
        classes = list(self._classes())
        names = {name for class_ in classes for name, _ in class_.fields}
        if names & _SHADOWING:
            # A field called `float` would hide the type in the rest of its class.
            self._builtins = "builtins."
            self._imports.add("import builtins")
        parts = [self._render(class_) for class_ in classes]
        imports = sorted(self._imports, key=lambda line: (line.startswith("from _"), line))
        metaclasses = [
            f"class Metaclass_{class_.name}({self._builtins}type): ..." for class_ in classes
        ]
        return "\n".join([*imports, "", *parts, *metaclasses, ""])

    def _classes(self) -> Iterator[_Class]:
        name = self._interface.name
        if self._interface.kind == "msg":
            yield _message(name, self._interface.sections[0])
        elif self._interface.kind == "srv":
            request, response = self._interface.sections
            yield from self._service(name, _members(request), _members(response))
        else:
            yield from self._action(name)

    def _service(
        self,
        name: str,
        request: _Members,
        response: _Members,
    ) -> Iterator[_Class]:
        own = self._interface.package
        yield _Class(f"{name}_Request", "Message", *request, {})
        yield _Class(f"{name}_Response", "Message", *response, {})
        fields = [
            ("info", _EVENT_INFO),
            ("request", FieldType(f"{name}_Request", own, is_array=True)),
            ("response", FieldType(f"{name}_Response", own, is_array=True)),
        ]
        yield _Class(f"{name}_Event", "Message", (), fields, {})
        base = f"Service[{name}_Request, {name}_Response]"
        parts = ("Request", "Response", "Event")
        yield _Class(name, base, (), (), {part: f"{name}_{part}" for part in parts})

    def _action(self, name: str) -> Iterator[_Class]:
        own = self._interface.package
        goal, result, feedback = self._interface.sections
        for part, section in (("Goal", goal), ("Result", result), ("Feedback", feedback)):
            yield _message(f"{name}_{part}", section)
        goal_id = ("goal_id", _UUID)
        yield from self._service(
            f"{name}_SendGoal",
            ((), [goal_id, ("goal", FieldType(f"{name}_Goal", own))]),
            ((), [("accepted", FieldType("bool")), ("stamp", _TIME)]),
        )
        yield from self._service(
            f"{name}_GetResult",
            ((), [goal_id]),
            ((), [("status", FieldType("int8")), ("result", FieldType(f"{name}_Result", own))]),
        )
        message = f"{name}_FeedbackMessage"
        fields = [goal_id, ("feedback", FieldType(f"{name}_Feedback", own))]
        yield _Class(message, "Message", (), fields, {})
        parts = ("Goal", "Result", "Feedback")
        base = f"Action[{', '.join(f'{name}_{part}' for part in parts)}]"
        inside = {part: f"{name}_{part}" for part in parts}
        yield _Class(name, base, (), (), inside, self._implementation(name))

    def _implementation(self, name: str) -> dict[str, str]:
        """Return the classes of the protocol of an action, as in ``Impl`` of generated code."""
        self._imports.add("from action_msgs.srv._cancel_goal import CancelGoal")
        self._imports.add("from action_msgs.msg._goal_status_array import GoalStatusArray")
        return {
            "SendGoalService": f"{name}_SendGoal",
            "GetResultService": f"{name}_GetResult",
            "FeedbackMessage": f"{name}_FeedbackMessage",
            "CancelGoalService": "CancelGoal",
            "GoalStatusMessage": "GoalStatusArray",
        }

    # -- one class

    def _render(self, class_: _Class) -> str:
        self._base(class_.base.partition("[")[0])
        lines = [f"class {class_.name}({class_.base}):"]
        lines += [self._constant(constant) for constant in class_.constants]
        lines += [f"    {name}: TypeAlias = {value}" for name, value in class_.inside.items()]
        if class_.inside:
            self._imports.add("from typing_extensions import TypeAlias")
            inner = class_.implementation.items()
            lines += ["    class Impl:"] if inner else []
            lines += [f"        {name}: TypeAlias = {value}" for name, value in inner]
            return "\n".join([*lines, ""])
        members = [self._member(name, type_) for name, type_ in class_.fields]
        for member in members:
            lines += self._attribute(member)
        arguments = [f"{member.name}: {member.written} = ..." for member in members]
        arguments.append(f"check_fields: {self._builtin('bool')} = ...")
        lines.append(f"    def __init__(self, *, {', '.join(arguments)}) -> None: ...")
        return "\n".join([*lines, ""])

    def _constant(self, constant: Constant) -> str:
        self._imports.add("from typing import Final")
        return f"    {constant.name}: Final = {_literal(constant.type, constant.value)}"

    def _attribute(self, member: _Member) -> list[str]:
        name = member.name
        if member.read == member.written:
            return [f"    {name}: {member.read}"]
        return [
            f"    @{self._builtin('property')}",
            f"    def {name}(self) -> {member.read}: ...",
            f"    @{name}.setter",
            f"    def {name}(self, value: {member.written}) -> None: ...",
        ]

    def _member(self, name: str, type_: FieldType) -> _Member:
        element = self._element(type_)
        if not type_.is_array:
            return _Member(name, element, element)
        code = _CODES.get(type_.name) if type_.is_primitive else None
        if code is None:
            accepted = "Items" if type_.name in TEXTS else "Iterable"
            if accepted == "Items":
                self._base(accepted)
            else:
                self._imports.add("from collections.abc import Iterable")
            read = f"{self._builtin('list')}[{element}]"
            return _Member(name, read, f"{accepted}[{element}]")
        accepted = "Floats" if type_.name in FLOATS else "Integers"
        self._base(accepted)
        if type_.array_size is None or type_.is_upper_bound:
            self._imports.add("import array as _array")
            return _Member(name, f"_array.array[{element}]", accepted)
        self._imports.add("import numpy as _numpy")
        self._imports.add("from numpy.typing import NDArray as _NDArray")
        return _Member(name, f"_NDArray[_numpy.{code}]", accepted)

    def _element(self, type_: FieldType) -> str:
        if not type_.is_primitive:
            return self._class_name(type_)
        if type_.name in FLOATS:
            return self._builtin("float")
        if type_.name in TEXTS:
            return self._builtin("str")
        return self._builtin({"bool": "bool", "byte": "bytes"}.get(type_.name, "int"))

    def _class_name(self, type_: FieldType) -> str:
        """Return the name of the class of a message in this module."""
        assert type_.package is not None  # noqa: S101  asked of interfaces alone
        if type_.package == self._interface.package and "_" in type_.name:
            return type_.name  # a part of this interface
        if type_.full_name in self._aliases:
            return self._aliases[type_.full_name]
        is_read = self._definitions.find(type_.full_name) is not None
        if not is_read and not self._is_elsewhere(type_):
            self._imports.add("from typing import Any")
            return "Any"
        taken = {*self._aliases.values(), self._interface.name}
        alias = type_.name if type_.name not in taken else f"{type_.package}_{type_.name}"
        self._aliases[type_.full_name] = alias
        path = f"{type_.package}.msg.{module_name(type_.name)}"
        renamed = "" if alias == type_.name else f" as {alias}"
        self._imports.add(f"from {path} import {type_.name}{renamed}")
        return alias

    def _is_elsewhere(self, type_: FieldType) -> bool:
        return self._others and type_.package != self._interface.package

    def _base(self, name: str) -> None:
        self._imports.add(f"from {BASE_MODULE} import {name}")

    def _builtin(self, name: str) -> str:
        return self._builtins + name


_SHADOWING = frozenset({"bool", "bytes", "float", "int", "list", "property", "str"})
_Members = tuple[Sequence[Constant], Sequence[tuple[str, FieldType]]]


def _message(name: str, section: Section) -> _Class:
    return _Class(name, "Message", *_members(section), {})


def _members(section: Section) -> _Members:
    return section.constants, list(_named(section.fields))


def _named(fields: Iterable[Field]) -> Iterator[tuple[str, FieldType]]:
    for field in fields:
        if not keyword.iskeyword(field.name):  # the class that is generated cannot be imported
            yield field.name, field.type


def _literal(type_: FieldType, value: Value) -> str:
    if type_.name == "byte" and isinstance(value, int):
        return repr(bytes([value]))
    if type_.name in FLOATS:
        return repr(value) if re.fullmatch(r"-?[0-9.e+-]+", repr(value)) else "float()"
    return repr(value)
