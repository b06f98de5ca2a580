"""CM062: interfaces are generated under the name of the project."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Edit, Example, Fix, Package, Report, Rule
from scaffold.api.cmake import generations

_LISTS = "project(my_msgs)\nrosidl_generate_interfaces(%s msg/Beat.msg)\n"
_MESSAGE = {"msg/Beat.msg": "int32 count\n"}


class InterfaceTargetDiffers(Rule):
    """The first argument of ``rosidl_generate_interfaces`` is not the name of the project.

    **Why.** The libraries are named after the argument, but Python and C++ look for them under
    the name of the package: ``UnsupportedTypeSupport: Could not import 'rosidl_typesupport_c'
    for package 'my_msgs'``.

    **Fix.** Write ``${PROJECT_NAME}``.

    **Source.** ROS 2 documentation, "Creating custom msg and srv files": the library name must
    match ``${PROJECT_NAME}``; https://github.com/ros2/rosidl/issues/441.
    """

    code = "CM062"
    name = "interface-target-differs"
    examples = (
        Example("the project", {"CMakeLists.txt": _LISTS % "${PROJECT_NAME}", **_MESSAGE}),
        Example("spelled out", {"CMakeLists.txt": _LISTS % "my_msgs", **_MESSAGE}),
        Example(
            "only for tests", {"CMakeLists.txt": _LISTS % "my_test_msgs SKIP_INSTALL", **_MESSAGE}
        ),
        Example(
            "another name",
            {"CMakeLists.txt": _LISTS % "messages", **_MESSAGE},
            Report(
                "CMakeLists.txt:2:28",
                "the interfaces are generated as 'messages', but the project is "
                "'my_msgs': their libraries are not found when they are used",
                fix="write ${PROJECT_NAME}",
            ),
            fixed={"CMakeLists.txt": _LISTS % "${PROJECT_NAME}"},
        ),
        Example(
            "a file",
            {"CMakeLists.txt": _LISTS % "msg/Rate.msg", **_MESSAGE},
            Report(
                "CMakeLists.txt:2:28",
                "the first argument must be a name, not the file 'msg/Rate.msg': "
                "insert ${PROJECT_NAME} before it",
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        cmake = package.cmake
        for call in generations(package):
            if call.target is None or cmake.project_name is None or call.for_tests:
                continue
            if call.target == cmake.project_name or call.options & {"SKIP_INSTALL", "LIBRARY_NAME"}:
                continue
            target = call.command.arguments[0]
            message = (
                f"the interfaces are generated as {call.target!r}, but the project is "
                f"{cmake.project_name!r}: their libraries are not found when they are used"
            )
            fix = None
            if "/" not in call.target and "." not in call.target:
                edit = Edit("CMakeLists.txt", target.start, target.end, "${PROJECT_NAME}")
                fix = Fix("write ${PROJECT_NAME}", (edit,))
            else:
                message = (
                    f"the first argument must be a name, not the file {call.target!r}: insert "
                    "${PROJECT_NAME} before it"
                )
            yield self.report(target, message, fix)
