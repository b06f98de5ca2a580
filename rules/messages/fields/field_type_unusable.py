"""MS009: field types of interfaces exist, and contain no message of their own."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Effect, Example, Location, Package, Rule, closure
from scaffold.api.distributions import removed_interface
from scaffold.api.interfaces import Definitions, FieldType, closest_word, interface_files

_LISTS = "project(my_msgs)\nrosidl_generate_interfaces(${PROJECT_NAME} {})\n"
_LISTS_LOOPS = (
    "project(my_msgs)\nrosidl_generate_interfaces(${PROJECT_NAME} msg/Node.msg msg/Tree.msg)\n"
)
_MANIFEST = "<package><name>my_msgs</name></package>\n"


class FieldTypeUnusable(Rule):
    """A field has a type that its package does not define, or that contains the message itself.

    **Why.** The build fails: the generated code includes a header that does not exist, such as
    ``my_msgs/msg/detail/header__struct.h``. A message that contains itself cannot be generated,
    not even with an array field.

    **Fix.** Write the type as ``package/Name``; without a package, it is looked up in the same
    package. For a tree, send a flat array whose elements contain the index of their parent.

    **Source.** ROS 2 documentation, "Interfaces": a type without a package;
    ``rosidl_generator_type_description``, which stops first (``KeyError``).
    """

    code = "MS009"
    name = "field-type-unusable"
    effect = Effect.STOPS_BUILD
    examples = (
        Example(
            "types from another package, from this package and from an unknown package",
            {
                "package.xml": "<package><name>my_msgs</name></package>\n",
                "CMakeLists.txt": _LISTS.replace("{}", "msg/Beat.msg msg/Beats.msg"),
                "msg/Beat.msg": "std_msgs/Header header\nunheard_msgs/Thing thing\n",
                "msg/Beats.msg": "Beat[] beats\n",
            },
        ),
        Example(
            "Header without its package, misspelled type",
            {
                "package.xml": "<package><name>my_msgs</name></package>\n",
                "CMakeLists.txt": _LISTS.replace("{}", "msg/Beat.msg"),
                "msg/Beat.msg": "Header header\ngeometry_msgs/Pont point\n",
            },
            "msg/Beat.msg:1:1: type 'my_msgs/Header': my_msgs has no message 'Header'; did you "
            "mean 'std_msgs/Header'?",
            "msg/Beat.msg:2:1: type 'geometry_msgs/Pont': geometry_msgs has no message 'Pont'; "
            "did you mean 'Point'?",
        ),
        Example(
            "type removed in this distribution",
            {
                "package.xml": "<package><name>my_msgs</name></package>\n",
                "CMakeLists.txt": _LISTS.replace("{}", "msg/Beat.msg"),
                "msg/Beat.msg": "geometry_msgs/Pose2D pose\n",
            },
            "msg/Beat.msg:1:1: type 'geometry_msgs/Pose2D' was removed in Lyrical; use "
            "geometry_msgs/msg/Pose, or a message of your own with x, y and theta, depending on "
            "the subscribers (common_interfaces 283)",
            distro="lyrical",
        ),
        Example(
            "array of another message",
            {
                "package.xml": _MANIFEST,
                "CMakeLists.txt": _LISTS_LOOPS,
                "msg/Node.msg": "int32 parent\n",
                "msg/Tree.msg": "Node[] nodes\n",
            },
        ),
        Example(
            "message that contains itself",
            {
                "package.xml": _MANIFEST,
                "CMakeLists.txt": _LISTS_LOOPS,
                "msg/Node.msg": "int32 id\nmy_msgs/Node[] children\n",
                "msg/Tree.msg": "Node root\n",
            },
            "msg/Node.msg:2:1: message 'Node' contains itself: the build stops",
        ),
        Example(
            "two messages that contain each other",
            {
                "package.xml": _MANIFEST,
                "CMakeLists.txt": _LISTS_LOOPS,
                "msg/Node.msg": "Tree tree\n",
                "msg/Tree.msg": "Node[] nodes\n",
            },
            "msg/Node.msg:1:1: message 'Node' contains 'Tree', which contains 'Node': the build "
            "stops",
            "msg/Tree.msg:1:1: message 'Tree' contains 'Node', which contains 'Tree': the build "
            "stops",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        yield from self._check_exists(package)
        yield from self._check_loops(package)

    def _check_exists(self, package: Package) -> Iterator[Diagnostic]:
        definitions = package.workspace.interfaces
        for file in interface_files(package):
            for field in file.definition.all_fields:
                message = _problem(definitions, field.type, str(field.type.element), package.name)
                if message:
                    yield self.report(field.type_location, message)

    def _check_loops(self, package: Package) -> Iterator[Diagnostic]:
        held: dict[str, dict[str, Location]] = {}
        for file in interface_files(package):
            if file.kind != "msg":
                continue
            inner = held.setdefault(file.name, {})
            for field in file.definition.all_fields:
                if field.type.package == package.name:
                    inner.setdefault(field.type.name, field.type_location)
        for name, inner in held.items():
            for type_, at in inner.items():
                if type_ == name:
                    yield self.report(at, f"message {name!r} contains itself: the build stops")
                elif name in closure([type_], lambda inner: held.get(inner, ())):
                    message = f"message {name!r} contains {type_!r}, which contains {name!r}: "
                    message += "the build stops"
                    yield self.report(at, message)


def _problem(definitions: Definitions, type_: FieldType, written: str, own: str) -> str | None:
    names = definitions.names(type_.package, "msg") if type_.package else None
    if names is None or type_.name in names:
        return None
    change = removed_interface(f"{type_.package}/msg/{type_.name}")
    if change is not None:
        return f"type {written!r} {change.state}; {change.advice} ({change.source})"
    others = definitions.matches(f"msg/{type_.name}")
    if others and type_.package == own:
        package, _, name = others[0].split("/")
        hint = f"; did you mean '{package}/{name}'?"
    else:
        hint = closest_word(type_.name, names)
    return f"type {written!r}: {type_.package} has no message {type_.name!r}{hint}"
