"""MS009: field types of interfaces exist."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule
from scaffold.api.distributions import removed_interface
from scaffold.api.interfaces import Definitions, FieldType, closest_word, interface_files

_LISTS = "project(my_msgs)\nrosidl_generate_interfaces(${PROJECT_NAME} {})\n"


class FieldTypeUnknown(Rule):
    """A field of an interface uses a type that its package does not define.

    **Why.** The build stops: the generated code includes a header that does not exist, such as
    ``my_msgs/msg/detail/header__struct.h``.

    **Fix.** Write the type as ``package/Name``; without a package, it is looked up in this one.

    **Source.** ROS 2 documentation, "Interfaces": a type without a package.
    """

    code = "MS009"
    name = "field-type-unknown"
    examples = (
        Example(
            "from another package, from this package, from an unknown package",
            {
                "package.xml": "<package><name>my_msgs</name></package>\n",
                "CMakeLists.txt": _LISTS.replace("{}", "msg/Beat.msg msg/Beats.msg"),
                "msg/Beat.msg": "std_msgs/Header header\nunheard_msgs/Thing thing\n",
                "msg/Beats.msg": "Beat[] beats\n",
            },
        ),
        Example(
            "a header without its package, a misspelled type",
            {
                "package.xml": "<package><name>my_msgs</name></package>\n",
                "CMakeLists.txt": _LISTS.replace("{}", "msg/Beat.msg"),
                "msg/Beat.msg": "Header header\ngeometry_msgs/Pont point\n",
            },
            Report(
                "msg/Beat.msg:1:1",
                "type 'my_msgs/Header': my_msgs has no message 'Header'; did you "
                "mean 'std_msgs/Header'?",
            ),
            Report(
                "msg/Beat.msg:2:1",
                "type 'geometry_msgs/Pont': geometry_msgs has no message 'Pont'; "
                "did you mean 'Point'?",
            ),
        ),
        Example(
            "a type that the distribution removed",
            {
                "package.xml": "<package><name>my_msgs</name></package>\n",
                "CMakeLists.txt": _LISTS.replace("{}", "msg/Beat.msg"),
                "msg/Beat.msg": "geometry_msgs/Pose2D pose\n",
            },
            Report(
                "msg/Beat.msg:1:1",
                "type 'geometry_msgs/Pose2D' was removed in Lyrical; use "
                "geometry_msgs/msg/Pose, or a message of your own with x, y and "
                "theta: which is right depends on who reads it (common_interfaces "
                "283)",
            ),
            distro="lyrical",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        definitions = package.workspace.interfaces
        for file in interface_files(package):
            for section in file.definition.sections:
                for field in section.fields:
                    message = _flaw(definitions, field.type, str(field.type.element), package.name)
                    if message:
                        yield self.report(field.type_location, message)


def _flaw(definitions: Definitions, type_: FieldType, written: str, own: str) -> str | None:
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
