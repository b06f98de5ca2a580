"""package.xml: the values of the manifest, with locations."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING

from scaffold.formats import xml_reader
from scaffold.formats.xml import Comment, Document, Element, Instruction
from scaffold.formats.xml_reader import decode
from scaffold.model.manifest.tags import DEPENDENCY_TAGS, PURPOSES
from scaffold.record import NamedTuple
from scaffold.source import Location, Source

if TYPE_CHECKING:
    from collections.abc import Container, Mapping

    from scaffold.edits import Edit

__all__ = [
    "DEPENDENCY_TAGS",
    "Dependency",
    "Element",
    "Manifest",
    "XmlModel",
    "decode",
]

NEWEST_FORMAT = 3

_OF_ROS2 = frozenset({"rclpy", "rclcpp", "rosidl_default_generators"})


class Dependency(NamedTuple):
    """A dependency on a package or a rosdep key."""

    name: str
    kind: str
    """The tag: ``exec_depend``, ``depend`` …"""
    element: Element
    condition: str | None

    @property
    def location(self) -> Location:
        """The place of the name."""
        return self.element.text_location

    @property
    def active(self) -> bool:
        """Whether its condition holds on Jazzy; a broken condition does not."""
        return _is_active(self.condition)

    @property
    def is_optional(self) -> bool:
        """Whether its condition has a custom variable, which is set by the user."""
        if self.condition is None:
            return False
        from scaffold.model.manifest import conditions

        return conditions.names_unknown(self.condition)

    @property
    def may_be_active(self) -> bool:
        """Whether its condition holds on the target, or depends on the user."""
        return self.active or self.is_optional


class XmlModel(NamedTuple):
    """The line that names the schema: ``<?xml-model href="…" schematypens="…"?>``."""

    href: str | None
    location: Location
    instruction: Instruction


class Manifest:
    """A package manifest, format 1 to 3."""

    def __init__(self, document: Document) -> None:
        self.document = document
        self.source: Source = document.source
        self.root: Element = document.root

    @classmethod
    def parse(cls, source: Source) -> Manifest:
        """Read a manifest.

        Raises:
            ParseError: it is not well-formed XML, or has a document type declaration.
        """
        return cls(xml_reader.parse(source))

    # -- elements

    def all(self, tag: str) -> list[Element]:
        """Return the elements with a tag directly below the root, in the order of the file."""
        return self._by_tag.get(tag, [])

    def one(self, tag: str) -> Element | None:
        """Return the first element with a tag directly below the root."""
        elements = self._by_tag.get(tag)
        return elements[0] if elements else None

    @cached_property
    def _by_tag(self) -> Mapping[str, list[Element]]:
        result: dict[str, list[Element]] = {}
        for child in self.root.children:
            result.setdefault(child.tag, []).append(child)
        return result

    @property
    def comments(self) -> list[Comment]:
        """All comments of the file."""
        return self.document.comments

    # -- identity

    @property
    def declared_format(self) -> str | None:
        """The attribute ``format`` as it is written."""
        return self.root.get("format")

    @property
    def format(self) -> int:
        """The format; 1 if undeclared, the newest if invalid."""
        declared = self.declared_format
        if declared is None:
            return 1
        try:
            return int(declared) if declared.isascii() else NEWEST_FORMAT
        except ValueError:
            return NEWEST_FORMAT

    @property
    def name(self) -> str:
        """The name of the package; empty when there is none."""
        return self._text("name")

    @property
    def version(self) -> str:
        """The version; empty when there is none."""
        return self._text("version")

    @property
    def description(self) -> str:
        """The description; empty when there is none."""
        return self._text("description")

    def _text(self, tag: str) -> str:
        element = self.one(tag)
        return element.text if element is not None else ""

    # -- dependencies

    @cached_property
    def dependencies(self) -> list[Dependency]:
        """The dependencies of every kind, in the order of the file."""
        return [
            Dependency(child.text, child.tag, child, child.get("condition"))
            for child in self.root.children
            if child.tag in PURPOSES
        ]

    def depends(self, *kinds: str) -> dict[str, Dependency]:
        """Return the dependencies of some kinds (by default all) by name.

        The first one is returned for duplicates. Conditions are not checked.
        """
        if kinds not in self._depends:
            result: dict[str, Dependency] = {}
            for dependency in self.dependencies:
                if not kinds or dependency.kind in kinds:
                    result.setdefault(dependency.name, dependency)
            self._depends[kinds] = result
        return self._depends[kinds]

    @cached_property
    def _depends(self) -> dict[tuple[str, ...], dict[str, Dependency]]:
        return {}

    def names_for(self, *purposes: str) -> set[str]:
        """Return the packages available on Jazzy for some purposes.

        Args:
            purposes: Of ``build``, ``build_export``, ``run``, ``test`` and ``doc``.
        """
        return {
            dependency.name
            for dependency in self.dependencies
            if not PURPOSES[dependency.kind].isdisjoint(purposes) and dependency.active
        }

    @cached_property
    def build_names(self) -> set[str]:
        """The packages available at build time: ``buildtool_``, ``build_`` and ``depend``."""
        return self.names_for("build")

    @cached_property
    def build_export_names(self) -> set[str]:
        """The packages available when another package is built against this one."""
        return self.names_for("build_export")

    @cached_property
    def run_names(self) -> set[str]:
        """The packages available at run time: ``exec_depend``, ``depend``, ``run_depend``."""
        return self.names_for("run")

    @cached_property
    def test_names(self) -> set[str]:
        """The packages only available for tests: ``test_depend``."""
        return self.names_for("test")

    @cached_property
    def declared_names(self) -> set[str]:
        """The names of all dependencies, whatever their conditions."""
        return {dependency.name for dependency in self.dependencies}

    def left_out(self, names: Container[str], *purposes: str) -> Dependency | None:
        """Return a dependency on one of some packages whose condition is false on the target.

        Args:
            names: The packages.
            purposes: As for `names_for`.
        """
        for dependency in self.dependencies:
            is_for_them = not PURPOSES[dependency.kind].isdisjoint(purposes)
            if dependency.name in names and is_for_them and not dependency.may_be_active:
                return dependency
        return None

    @property
    def groups(self) -> list[Element]:
        """The elements ``group_depend`` and ``member_of_group``."""
        tags = {"group_depend", "member_of_group"}
        return [child for child in self.root.children if child.tag in tags]

    def member_of(self, group: str) -> bool:
        """Return whether the package is a member of a group."""
        return any(
            element.text == group and _is_active(element.get("condition"))
            for element in self.all("member_of_group")
        )

    # -- export

    @cached_property
    def exports(self) -> list[Element]:
        """The elements inside ``<export>``."""
        return [child for export in self.all("export") for child in export.children]

    def note_on_export(self, text: str) -> str:
        """Return a note for a missing element that is inside ``<export>``."""
        for child in self.exports:
            if child.text == text and (child.tag in PURPOSES or child.tag == "member_of_group"):
                return f"; line {child.location.line} is inside <export>, where it has no effect"
        return ""

    @cached_property
    def build_type_elements(self) -> list[Element]:
        """The ``<build_type>`` elements inside ``<export>``, whatever their conditions."""
        return [element for element in self.exports if element.tag == "build_type"]

    @property
    def build_type(self) -> str | None:
        """The build type on Jazzy; the last one, if there are several."""
        result = [
            element.text
            for element in self.build_type_elements
            if _is_active(element.get("condition"))
        ]
        return result[-1] if result else None

    @cached_property
    def catkin(self) -> Dependency | None:
        """The dependency on catkin of a package only for ROS 1."""
        names = self.build_names | self.run_names
        is_for_ros2 = bool(names & _OF_ROS2) or any(name.startswith("ament_") for name in names)
        if is_for_ros2 or self.build_type not in {None, "catkin"}:
            return None
        catkin = self.depends("buildtool_depend", "build_depend", "depend").get("catkin")
        return catkin if catkin is not None and catkin.condition is None else None

    # -- around the root

    @cached_property
    def xml_models(self) -> list[XmlModel]:
        """All ``<?xml-model …?>`` lines."""
        return [
            XmlModel(instruction.pseudo_attributes.get("href"), instruction.location, instruction)
            for instruction in self.document.instructions
            if instruction.target == "xml-model"
        ]

    # -- edits

    def insert(self, tag: str, text: str, attributes: Mapping[str, str] | None = None) -> Edit:
        """Return the edit that adds an element below the root, in order."""
        from scaffold.model.manifest import edit as manifest_edit

        return manifest_edit.insert(self.document, tag, text, attributes)

    def remove(self, element: Element) -> Edit:
        """Return the edit that removes an element, with its line if it is alone there."""
        from scaffold.model.manifest import edit as manifest_edit

        return manifest_edit.remove(self.document, element)


def _is_active(condition: str | None) -> bool:
    if condition is None:
        return True
    from scaffold.model.manifest import conditions  # few manifests have one

    try:
        return conditions.holds(condition)
    except conditions.ConditionError:
        return False
