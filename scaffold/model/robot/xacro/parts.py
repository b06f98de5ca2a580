"""The output of an expansion: elements, and the files that they refer to."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from scaffold.record import NamedTuple
from scaffold.source import Location

if TYPE_CHECKING:
    from scaffold.formats.xml import Element
    from scaffold.model.robot.files import RobotFile

NOT_URDF = frozenset({"gazebo", "ros2_control", "transmission", "sensor", "plugin", "sdf"})
"""Elements with content for other readers."""


class Part:
    """An element of the output."""

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
        """Whether it exists for all arguments."""
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
        """Return the location of the value of an attribute, or of the tag without one."""
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


class NamedFile(NamedTuple):
    """A file referenced by another one."""

    package: str
    """The package of its share directory; empty if the path is relative to a file."""
    path: str
    """Relative to that directory, or to the package."""
    user: str
    """The path of the referring file."""
    location: Location
    is_certain: bool
    """Whether it is referenced for all arguments."""


def is_for_others(part: Part | None) -> bool:
    """Return whether an element or a parent is for readers other than urdfdom."""
    while part is not None and part.tag not in NOT_URDF:
        part = part.holder
    return part is not None
