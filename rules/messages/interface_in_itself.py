"""MS011: no message contains itself."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from scaffold.api import Diagnostic, Example, Location, Package, Report, Rule
from scaffold.api.interfaces import interface_files

_LISTS = "project(my_msgs)\nrosidl_generate_interfaces(${PROJECT_NAME} msg/Node.msg msg/Tree.msg)\n"
_MANIFEST = "<package><name>my_msgs</name></package>\n"


class InterfaceInItself(Rule):
    """A message has a field of its own type, or of a type that contains it in turn.

    **Why.** The build stops: the generated structures would be infinite. An array does not help.

    **Fix.** Send a flat list, and refer to the parent of each element by its index.

    **Source.** ``rosidl_generator_type_description``, which stops first (``KeyError``).
    """

    code = "MS011"
    name = "interface-in-itself"
    examples = (
        Example(
            "a list of other messages",
            {
                "package.xml": _MANIFEST,
                "CMakeLists.txt": _LISTS,
                "msg/Node.msg": "int32 parent\n",
                "msg/Tree.msg": "Node[] nodes\n",
            },
        ),
        Example(
            "itself",
            {
                "package.xml": _MANIFEST,
                "CMakeLists.txt": _LISTS,
                "msg/Node.msg": "int32 id\nmy_msgs/Node[] children\n",
                "msg/Tree.msg": "Node root\n",
            },
            Report("msg/Node.msg:2:1", "message 'Node' contains itself: the build stops"),
        ),
        Example(
            "each other",
            {
                "package.xml": _MANIFEST,
                "CMakeLists.txt": _LISTS,
                "msg/Node.msg": "Tree tree\n",
                "msg/Tree.msg": "Node[] nodes\n",
            },
            Report(
                "msg/Node.msg:1:1",
                "message 'Node' contains 'Tree', which contains 'Node': the build stops",
            ),
            Report(
                "msg/Tree.msg:1:1",
                "message 'Tree' contains 'Node', which contains 'Tree': the build stops",
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        held: dict[str, dict[str, Location]] = {}
        for file in interface_files(package):
            if file.kind != "msg":
                continue
            inner = held.setdefault(file.name, {})
            for section in file.definition.sections:
                for field in section.fields:
                    if field.type.package == package.name:
                        inner.setdefault(field.type.name, field.type_location)
        for name, inner in held.items():
            for type_, at in inner.items():
                if type_ == name:
                    yield self.report(at, f"message {name!r} contains itself: the build stops")
                elif name in _reached(held, type_):
                    message = f"message {name!r} contains {type_!r}, which contains {name!r}: "
                    message += "the build stops"
                    yield self.report(at, message)


def _reached(held: Mapping[str, Mapping[str, Location]], name: str) -> set[str]:
    """Return the messages of the package that a message contains, directly or not."""
    reached: set[str] = set()
    pending = [name]
    while pending:
        for inner in held.get(pending.pop(), ()):
            if inner not in reached:
                reached.add(inner)
                pending.append(inner)
    return reached
