"""Finds interfaces by name, with all the messages that they contain."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence

from scaffold.errors import InputError
from scaffold.model.interfaces.definitions import Definitions, Interface, spell
from scaffold.model.interfaces.syntax import Field, Section

WORDS = {"msg": "message", "srv": "service", "action": "action"}
"""Words for the kinds of interfaces."""
HEADER = "std_msgs/msg/Header"
TIME = "builtin_interfaces/msg/Time"
DURATION = "builtin_interfaces/msg/Duration"
_IMPORTED = {
    "GoalStatus": "action_msgs/msg/GoalStatus",
    "Transition": "lifecycle_msgs/msg/Transition",
}
"""Messages that generated code imports for all types."""
_TAKEN = {
    "msg": frozenset({"LifecycleNode", "Node", "Source", "Transition"}),
    "srv": frozenset({"Client", "Node", "Server"}),
    "action": frozenset(
        {"ActionClient", "ActionServer", "CancelResponse", "Client", "Event", "Future"}
        | {"GoalResponse", "GoalStatus", "MultiThreadedExecutor", "Node", "Server"}
        | {"SignalHandlerOptions"}
    ),
}
"""Names with another meaning where interfaces of a kind are used."""
VECTOR = "geometry_msgs/msg/Vector3"


class Types:
    """An interface and the messages of its fields, all of which are known."""

    def __init__(
        self, interface: Interface, messages: Mapping[str, Interface], definitions: Definitions
    ) -> None:
        self.interface = interface
        self._messages = messages
        self._definitions = definitions

    def message(self, full_name: str) -> Section:
        """Return the fields and constants of a message by ``package/msg/Name``."""
        return self._messages[full_name].section("message")

    def class_name(self, full_name: str) -> str:
        """Return the class name of a message in code: its own, unless another class has it."""
        package, _, name = full_name.split("/")
        if self.full_name(name) == full_name:
            return name
        own = self.interface
        is_double = (package, name) == (own.package, own.name) and full_name != own.full_name
        longer = "".join(word.capitalize() for word in package.split("_")) + name
        return f"{longer}Message" if is_double else longer

    @property
    def own_name(self) -> str:
        """The class name of the interface in code."""
        return self.class_name(self.interface.full_name)

    @property
    def own_alias(self) -> str:
        """The original name of the interface, if its class name in code differs."""
        return self.interface.name if self.own_name != self.interface.name else ""

    def renamed(self, code: str, full_name: str) -> str:
        """Return the code of a recipe with the class names of messages used here."""
        package = full_name.partition("/")[0]
        for name in set(re.findall(r"(?<![.\w])[A-Z]\w+", code)):
            candidates = [
                message for message in sorted(self._messages) if message.endswith(f"/{name}")
            ]
            if candidates:
                own = f"{package}/msg/{name}"
                new = self.class_name(
                    own if own in candidates else min(candidates, key=_is_uncommon)
                )
                code = re.sub(rf"(?<![.\w]){name}\b", new, code)
        return code

    def full_name(self, class_name: str) -> str | None:
        """Return the message with a class name in code; ``None`` if there is none.

        The interface itself takes precedence, then the messages of its fields, then those of
        the same packages.
        """
        own = self.interface
        if class_name in _TAKEN[own.kind]:
            full_name = _IMPORTED.get(class_name, "")
            return full_name if full_name in self._messages else None
        if class_name == own.name:
            return own.full_name
        candidates = sorted(self._messages)
        for name in candidates:
            if name.endswith(f"/{class_name}"):
                return name
        for name in candidates:
            if self.class_name(name) == class_name:
                return name
        for package in dict.fromkeys(
            [own.package, *(name.partition("/")[0] for name in candidates)]
        ):
            if class_name in (self._definitions.names(package, "msg") or ()):
                return f"{package}/msg/{class_name}"
        return None


def _is_uncommon(full_name: str) -> bool:
    return not full_name.startswith(("geometry_msgs/", "std_msgs/"))


def find(text: str, kind: str, definitions: Definitions) -> Types:
    """Return the interface with a name given by the user.

    Args:
        text: ``package/kind/Name``, ``package/Name`` or a bare ``Name``.
        kind: ``msg``, ``srv`` or ``action``.
        definitions: Where to look.

    Raises:
        InputError: there is none, there are several, or it cannot be used; the message names
            the nearest ones, or the file and the line of what is wrong.
    """
    full_name = _full_name(text, kind, definitions)
    interface = definitions.find(full_name) or definitions.resolve(full_name)
    messages: dict[str, Interface] = {}
    if kind == "msg":
        messages[full_name] = interface
    for field in interface.all_fields:
        trail = (full_name,) if kind == "msg" else ()
        _collect(field, interface, trail, messages, definitions)
    return Types(interface, messages, definitions)


def _full_name(text: str, kind: str, definitions: Definitions) -> str:
    word = WORDS[kind]
    wanted = spell(text)
    if wanted.kind not in {None, kind}:
        raise InputError(f"{text!r} is a type of {WORDS[str(wanted.kind)]}s, not of {word}s")
    package = f"{wanted.package}/" if wanted.package else ""
    matches = definitions.matches(f"{package}{kind}/{wanted.name}") if wanted.name else []
    if not matches and package and definitions.find(f"{package}{kind}/{wanted.name}"):
        matches = [f"{package}{kind}/{wanted.name}"]  # of a package that may have more
    if len(matches) > 1:
        raise InputError(
            f"{text!r} may be {', '.join(matches[:-1])} or {matches[-1]}; use the full name"
        )
    if matches:
        return matches[0]
    closest = _nearest(text, kind, definitions)
    hint = f"; did you mean {' or '.join(closest)}?" if closest else ""
    raise InputError(f"unknown {word} type {text!r}{hint}")


def _nearest(text: str, kind: str, definitions: Definitions) -> list[str]:
    """Return the types of a kind closest to a misspelled one, best first."""
    if not text.strip():
        return []
    names = definitions.nearest(text, 100)
    return [name for name in names if f"/{kind}/" in name][:3]


def _collect(
    field: Field,
    owner: Interface,
    trail: Sequence[str],
    collected: dict[str, Interface],
    definitions: Definitions,
) -> None:
    """Add the message of a field, and those of its fields.

    Raises:
        InputError: one is unknown, broken, or contains itself.
    """
    if field.type.is_primitive:
        return
    name = field.type.full_name
    at = f"{owner.origin}:{field.location.line}"
    if name in trail:
        circle = " -> ".join([*trail[trail.index(name) :], name])
        raise InputError(f"{at}: the field {field.name!r} makes a message contain itself: {circle}")
    if name in collected:
        return
    interface = definitions.find(name)
    if interface is None:
        try:
            interface = definitions.resolve(name)
        except InputError as error:
            raise InputError(f"{at}: the field {field.name!r} cannot be filled: {error}") from error
    collected[name] = interface
    for part in interface.fields:
        _collect(part, interface, [*trail, name], collected, definitions)
