"""The Python classes of messages, and of the parts of services and actions."""

from __future__ import annotations

from scaffold.model.interfaces.definitions import Definitions, Interface
from scaffold.model.interfaces.syntax import Section
from scaffold.record import NamedTuple

PARTS = {
    "msg": {},
    "srv": {"Request": "request", "Response": "response"},
    "action": {"Goal": "goal", "Result": "result", "Feedback": "feedback"},
}
"""The nested classes of services and actions, with their sections."""
_NOT_FIELDS = frozenset({"get_fields_and_field_types", "SLOT_TYPES", "check_fields"})
"""Attributes of all classes that are no fields."""


class MessageClass(NamedTuple):
    """A Python class of a message, or of a part of a service or an action."""

    interface: Interface
    section: Section
    part: str
    """``Request`` ...; empty for a message."""

    @property
    def name(self) -> str:
        """``std_msgs/msg/String``; of a part ``std_srvs/srv/SetBool.Request``."""
        return self.interface.full_name + (f".{self.part}" if self.part else "")

    @property
    def origin(self) -> str:
        """The origin of the definition."""
        return self.interface.origin

    def allows(self, attribute: str) -> bool:
        """Return whether objects of the class may have an attribute."""
        return (
            attribute.startswith("_")
            or attribute.endswith("__DEFAULT")
            or attribute in _NOT_FIELDS
            or self.section.field(attribute) is not None
            or self.section.constant(attribute) is not None
        )


def class_named(definitions: Definitions, dotted: str) -> MessageClass | None:
    """Return the class of a full Python name: ``std_srvs.srv.SetBool.Request``."""
    package, _, rest = dotted.partition(".")
    kind, _, name = rest.partition(".")
    if kind not in PARTS or not name:
        return None
    name, dot, part = name.partition(".")
    if not dot and "_" in name:
        name, _, part = name.rpartition("_")
    interface = definitions.find(f"{package}/{kind}/{name}")
    if interface is None:
        return None
    if kind == "msg":
        return None if part else MessageClass(interface, interface.sections[0], "")
    section = PARTS[kind].get(part)
    return MessageClass(interface, interface.section(section), part) if section else None
