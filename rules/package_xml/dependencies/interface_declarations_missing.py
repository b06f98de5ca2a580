"""PX040: packages that generate interfaces have the required declarations."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Edit, Effect, Example, Fix, Package, Report, Rule, Severity
from scaffold.api.catalog import transitive_dependencies
from scaffold.api.cmake import generations, is_interface_package
from scaffold.api.manifest import Manifest

GROUP = "rosidl_interface_packages"
_GENERATORS = ("rosidl_default_generators", "rosidl_core_generators")
_KINDS = ("_msgs", "_srvs", "_interfaces")
"""Suffixes of the names of interface packages."""
_RUNTIMES = ("rosidl_default_runtime", "rosidl_core_runtime")
_CMAKE = "project(my_msgs)\nrosidl_generate_interfaces(${PROJECT_NAME} msg/Beat.msg)\n"
_FILES = {"CMakeLists.txt": _CMAKE, "msg/Beat.msg": "int32 count\n"}
_MANIFEST = '<package format="3">\n  <name>my_msgs</name>\n{}</package>\n'
_BUILD = "  <buildtool_depend>rosidl_default_generators</buildtool_depend>\n"
_RUN = "  <exec_depend>rosidl_default_runtime</exec_depend>\n"
_MEMBER = f"  <member_of_group>{GROUP}</member_of_group>\n"


class InterfaceDeclarationsMissing(Rule):
    """A package generates interfaces, but lacks the required dependencies or group.

    **Why.** Without the group CMake stops: ``Packages installing interfaces must include
    '<member_of_group>rosidl_interface_packages</member_of_group>'``. Without the dependencies, it
    builds only on the author's machine. It is a warning if another message package depends on the
    runtime.

    **Fix.** Declare ``rosidl_default_generators`` for the build, ``rosidl_default_runtime`` for run
    time, and the group.

    **Source.** ROS 2 documentation, "Creating custom msg and srv files";
    ``rosidl_cmake/cmake/rosidl_generate_interfaces.cmake``.
    """

    code = "PX040"
    name = "interface-declarations-missing"
    effect = Effect.STOPS_BUILD
    other_severities = {Severity.WARNING: "another declared message package depends on the runtime"}
    examples = (
        Example("all three", {"package.xml": _MANIFEST.format(_BUILD + _RUN + _MEMBER), **_FILES}),
        Example(
            "another message package depends on the generators",
            {
                "package.xml": _MANIFEST.format(
                    _RUN + "  <depend>nav_2d_msgs</depend>\n" + _MEMBER
                ),
                **_FILES,
            },
        ),
        Example(
            "without the group",
            {"package.xml": _MANIFEST.format(_BUILD + _RUN), **_FILES},
            Report(
                "package.xml:4:4",
                "CMakeLists.txt:2 generates interfaces, but no <member_of_group> "
                "rosidl_interface_packages: CMake stops",
                fix="Add <member_of_group>rosidl_interface_packages</member_of_group>",
            ),
            fixed={"package.xml": _MANIFEST.format(_BUILD + _RUN + _MEMBER)},
        ),
        Example(
            "another message package depends on the runtime",
            {
                "package.xml": _MANIFEST.format(_BUILD + "  <depend>std_msgs</depend>\n" + _MEMBER),
                **_FILES,
            },
            Report(
                "package.xml:4:4",
                "CMakeLists.txt:2 generates interfaces, but no <exec_depend> "
                "rosidl_default_runtime",
                fix="Add <exec_depend>rosidl_default_runtime</exec_depend>",
                severity=Severity.WARNING,
            ),
            fixed={
                "package.xml": _MANIFEST.format(
                    _BUILD + _RUN + "  <depend>std_msgs</depend>\n" + _MEMBER
                )
            },
        ),
        Example(
            "no declarations",
            {"package.xml": _MANIFEST.format(""), **_FILES},
            Report(
                "package.xml:1:2",
                "CMakeLists.txt:2 generates interfaces, but no <buildtool_depend> "
                "rosidl_default_generators",
                fix="Add <buildtool_depend>rosidl_default_generators</buildtool_depend>",
            ),
            Report(
                "package.xml:1:2",
                "CMakeLists.txt:2 generates interfaces, but no <exec_depend> "
                "rosidl_default_runtime",
                fix="Add <exec_depend>rosidl_default_runtime</exec_depend>",
            ),
            Report(
                "package.xml:1:2",
                "CMakeLists.txt:2 generates interfaces, but no <member_of_group> "
                "rosidl_interface_packages: CMake stops",
                fix="Add <member_of_group>rosidl_interface_packages</member_of_group>",
            ),
            fixed={"package.xml": _MANIFEST.format(_BUILD + _RUN + _MEMBER)},
        ),
        Example(
            "inside of <export>",
            {
                "package.xml": _MANIFEST.format(
                    f"{_BUILD}{_MEMBER}  <export>\n  {_RUN}  </export>\n"
                ),
                **_FILES,
            },
            Report(
                "package.xml:3:4",
                "CMakeLists.txt:2 generates interfaces, but no <exec_depend> "
                "rosidl_default_runtime; line 6 is inside <export>, where it has no "
                "effect",
                fix="Add <exec_depend>rosidl_default_runtime</exec_depend>",
            ),
            fixed={
                "package.xml": _MANIFEST.format(
                    f"{_BUILD}{_RUN}{_MEMBER}  <export>\n  {_RUN}  </export>\n"
                )
            },
        ),
        Example(
            "package format 2, which has no groups",
            {"package.xml": _MANIFEST.format(_BUILD + _RUN).replace('"3"', '"2"'), **_FILES},
            Report(
                "package.xml:4:4",
                "CMakeLists.txt:2 generates interfaces, but no <member_of_group> "
                "rosidl_interface_packages: CMake stops; groups need package format 3",
                fix="Add <member_of_group>rosidl_interface_packages</member_of_group>",
            ),
            fixed={"package.xml": _MANIFEST.format(_BUILD + _RUN + _MEMBER)},
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        if not is_interface_package(package):
            return
        manifest = package.manifest
        last = manifest.dependencies[-1].element if manifest.dependencies else manifest.root
        line = generations(package)[0].command.location.line
        for problem, tag, text in _missing(manifest, package):
            message = f"CMakeLists.txt:{line} generates interfaces, but {problem}"
            message += manifest.note_on_export(text)
            changes = [manifest.insert(tag, text)]
            changes += _format_3(manifest) if tag == "member_of_group" else []
            fix = Fix(f"Add <{tag}>{text}</{tag}>", tuple(changes))
            is_there = text in _RUNTIMES and any(n.endswith(_KINDS) for n in manifest.run_names)
            severity = Severity.WARNING if is_there else Severity.ERROR
            yield self.report(last.name_location, message, fix, severity=severity)


def _missing(manifest: Manifest, package: Package) -> Iterator[tuple[str, str, str]]:
    """Yield the missing declarations: description, tag and text."""
    build = manifest.build_names | manifest.run_names
    build |= transitive_dependencies(build)
    if build.isdisjoint(_GENERATORS):
        tag = "buildtool_depend"
        yield f"no <{tag}> {_GENERATORS[0]}", tag, _GENERATORS[0]
    if manifest.run_names.isdisjoint(_RUNTIMES):
        tag = "exec_depend" if manifest.format > 1 else "run_depend"
        yield f"no <{tag}> {_RUNTIMES[0]}", tag, _RUNTIMES[0]
    skips = [call.options & {"SKIP_GROUP_MEMBERSHIP_CHECK"} for call in generations(package)]
    if not manifest.member_of(GROUP) and not all(skips):
        message = f"no <member_of_group> {GROUP}: CMake stops"
        if manifest.format < 3:  # noqa: PLR2004  REP 149
            message += "; groups need package format 3"
        yield message, "member_of_group", GROUP


def _format_3(manifest: Manifest) -> list[Edit]:
    """Return the change of a manifest from format 2 to 3, which is compatible."""
    attribute = manifest.root.attributes.get("format")
    if manifest.format != 2 or attribute is None:  # noqa: PLR2004  REP 140
        return []
    at = attribute.location
    start = manifest.source.offset(at.line, at.column)
    end = manifest.source.offset(at.end_line, at.end_column)
    return [Edit("package.xml", start, end, "3")]
