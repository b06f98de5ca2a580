"""CM060: interface files are generated, under the name of the project."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Edit, Example, Fix, Package, Report, Rule, Safety, Severity
from scaffold.api.cmake import Generation, generations, may_generate_more, uses_ament
from scaffold.api.interfaces import is_commented_out, names_used_in_code, ungenerated_candidates

_LISTS = "project(my_msgs)\nrosidl_generate_interfaces(%s msg/Beat.msg)\n"
_MESSAGE = {"msg/Beat.msg": "int32 count\n"}
_LISTS_FILES = "project(my_msgs)\nrosidl_generate_interfaces(${PROJECT_NAME}\n  %s\n)\n"


class InterfaceNotGenerated(Rule):
    """A .msg, .srv or .action file is not generated, or not under the name of the project.

    **Why.** The build succeeds, but ``ros2 interface show`` and every import fail. The libraries
    are named after the first argument, but Python and C++ load them by the name of the package:
    ``UnsupportedTypeSupport: Could not import 'rosidl_typesupport_c' for package 'my_msgs'``. It is
    a warning if no code in the workspace imports the type from this package.

    **Fix.** Add the file to ``rosidl_generate_interfaces(${PROJECT_NAME} ...)``. ament_python
    packages cannot generate interfaces: move the file to an ament_cmake package.

    **Source.** ROS 2 documentation, "Creating custom msg and srv files": the library name must
    match ``${PROJECT_NAME}``; https://github.com/ros2/rosidl/issues/441.
    """

    code = "CM060"
    name = "interface-not-generated"
    other_severities = {Severity.WARNING: "no code in the workspace imports the interface"}
    examples = (
        Example(
            "under the name of the project",
            {"CMakeLists.txt": _LISTS % "${PROJECT_NAME}", **_MESSAGE},
        ),
        Example(
            "the project name, spelled out",
            {"CMakeLists.txt": _LISTS % "my_msgs", **_MESSAGE},
        ),
        Example(
            "under another name, only for tests",
            {"CMakeLists.txt": _LISTS % "my_test_msgs SKIP_INSTALL", **_MESSAGE},
        ),
        Example(
            "under another name",
            {"CMakeLists.txt": _LISTS % "messages", **_MESSAGE},
            Report(
                "CMakeLists.txt:2:28",
                "the interfaces are generated as 'messages', but the project is "
                "'my_msgs': their libraries are not found at run time",
                fix="Replace the name with ${PROJECT_NAME}",
            ),
            fixed={"CMakeLists.txt": _LISTS % "${PROJECT_NAME}"},
        ),
        Example(
            "a file instead of the name",
            {"CMakeLists.txt": _LISTS % "msg/Rate.msg", **_MESSAGE},
            "CMakeLists.txt:2:28: the first argument must be a name, not the file 'msg/Rate.msg': "
            "insert ${PROJECT_NAME} before it",
        ),
        Example(
            "listed; omitted on purpose, as a comment says; a file for tests",
            {
                "CMakeLists.txt": _LISTS_FILES % "msg/Beat.msg\n  # msg/Old.msg",
                "msg/Beat.msg": "int32 count\n",
                "msg/Old.msg": "int32 count\n",
                "test/msg/Other.msg": "int32 count\n",
            },
        ),
        Example(
            "not listed",
            {
                "CMakeLists.txt": _LISTS_FILES % '"msg/Beat.msg"',
                "msg/Beat.msg": "int32 count\n",
                "srv/Add.srv": "int32 a\n---\nint32 b\n",
            },
            Report(
                "CMakeLists.txt:2:1",
                "srv/Add.srv is not listed: no code is generated for Add; add it",
                fix="Add srv/Add.srv",
                severity=Severity.WARNING,
            ),
            fixed={"CMakeLists.txt": _LISTS_FILES % '"msg/Beat.msg"\n  "srv/Add.srv"'},
        ),
        Example(
            "not listed, and only named by another one that is not listed",
            {
                "package.xml": "<package><name>walker</name></package>\n",
                "CMakeLists.txt": _LISTS_FILES % '"msg/Beat.msg"',
                "msg/Beat.msg": "int32 count\n",
                "msg/Arm.msg": "walker/Hand[] hands\n",
                "msg/Hand.msg": "int32 a\n",
            },
            Report(
                "CMakeLists.txt:2:1",
                "msg/Arm.msg is not listed: no code is generated for Arm; add it",
                fix="Add msg/Arm.msg",
                severity=Severity.WARNING,
            ),
            Report(
                "CMakeLists.txt:2:1",
                "msg/Hand.msg is not listed: no code is generated for Hand; add it",
                fix="Add msg/Hand.msg",
                severity=Severity.WARNING,
            ),
            fixed={
                "CMakeLists.txt": _LISTS_FILES % '"msg/Beat.msg"\n  "msg/Arm.msg"\n  "msg/Hand.msg"'
            },
        ),
        Example(
            "nothing is generated",
            {
                "package.xml": "<package><name>my_msgs</name></package>\n",
                "CMakeLists.txt": "project(my_msgs)\nfind_package(ament_cmake REQUIRED)\n",
                "msg/Beat.msg": "int32 count\n",
            },
            Report(
                "CMakeLists.txt:1:1",
                "msg/Beat.msg is never generated: call rosidl_generate_interfaces()",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "nothing is generated, and only a comment uses it",
            {
                "package.xml": "<package><name>my_msgs</name></package>\n",
                "CMakeLists.txt": "project(my_msgs)\nfind_package(ament_cmake REQUIRED)\n",
                "msg/Beat.msg": "int32 count\n",
                "src/talk.cpp": "// using my_msgs::msg::Beat;\nint main() { return 0; }\n",
            },
            Report(
                "CMakeLists.txt:1:1",
                "msg/Beat.msg is never generated: call rosidl_generate_interfaces()",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "in a Python package",
            {
                "package.xml": "<package><name>robot</name><export>"
                "<build_type>ament_python</build_type></export></package>\n",
                "setup.py": "",
                "msg/Beat.msg": "int32 count\n",
                "msg/Old.msg": "int32 count\n",
                "robot/talker.py": "from robot.msg import Beat\n",
            },
            "msg/Beat.msg:1:1: an ament_python package cannot generate interfaces; move the file "
            "to an ament_cmake package",
            Report(
                "msg/Old.msg:1:1",
                "an ament_python package cannot generate interfaces; move the file to an "
                "ament_cmake package",
                severity=Severity.WARNING,
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        yield from self._check_files(package)
        yield from self._check_target(package)

    def _check_target(self, package: Package) -> Iterator[Diagnostic]:
        cmake = package.cmake
        for call in generations(package):
            if call.target is None or cmake.project_name is None or call.for_tests:
                continue
            if call.target == cmake.project_name or call.options & {"SKIP_INSTALL", "LIBRARY_NAME"}:
                continue
            target = call.command.arguments[0]
            message = (
                f"the interfaces are generated as {call.target!r}, but the project is "
                f"{cmake.project_name!r}: their libraries are not found at run time"
            )
            fix = None
            if "/" not in call.target and "." not in call.target:
                edit = Edit(target.path, target.start, target.end, "${PROJECT_NAME}")
                fix = Fix("Replace the name with ${PROJECT_NAME}", (edit,))
            else:
                message = (
                    f"the first argument must be a name, not the file {call.target!r}: insert "
                    "${PROJECT_NAME} before it"
                )
            yield self.report(target, message, fix)

    def _check_files(self, package: Package) -> Iterator[Diagnostic]:
        files = ungenerated_candidates(package)
        if not files:
            return
        used = names_used_in_code(package)
        if package.build_type == "ament_python":
            for path in files:
                message = (
                    "an ament_python package cannot generate interfaces; move the file to "
                    "an ament_cmake package"
                )
                at = package.start_of(path)
                yield self.report(at, message, severity=_severity(_type_of(path) in used))
            return
        calls = generations(package)
        if not all(call.is_complete for call in calls) or may_generate_more(package):
            return
        if not calls:
            project = package.cmake.project
            if project is not None and uses_ament(package):
                message = f"{files[0]} is never generated: call rosidl_generate_interfaces()"
                is_used = any(_type_of(path) in used for path in files)
                yield self.report(project.name_location, message, severity=_severity(is_used))
            return
        listed = {file.path for call in calls for file in call.files}
        for path in files:
            if path in listed or is_commented_out(package, path):
                continue
            name = _type_of(path)
            message = f"{path} is not listed: no code is generated for {name}; add it"
            yield self.report(
                calls[0].command.name_location,
                message,
                _add(calls[0], path),
                severity=_severity(name in used),
            )


def _type_of(path: str) -> str:
    return path.rpartition("/")[2].rpartition(".")[0]


def _severity(is_used: bool) -> Severity:  # noqa: FBT001  its name says it
    return Severity.ERROR if is_used else Severity.WARNING


def _add(call: Generation, path: str) -> Fix | None:
    literal = [file.argument for file in call.files if file.argument in call.command.arguments]
    if not literal:
        return None
    last = literal[-1]
    text = f'"{path}"' if last.quoted else path
    indent = " " * (last.location.column - 1)
    on_own_line = last.location.line > call.command.location.line
    separator = f"\n{indent}" if on_own_line else " "
    edit = Edit(last.path, last.end, last.end, separator + text)
    return Fix(f"Add {path}", (edit,), Safety.SAFE)
