"""CM061: the interface files that are listed exist."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule
from scaffold.api.cmake import generations
from scaffold.api.interfaces import SECTIONS, closest_word

_LISTS = "project(my_msgs)\nset(files %s)\nrosidl_generate_interfaces(${PROJECT_NAME} ${files})\n"


class InterfaceFileMissing(Rule):
    """``rosidl_generate_interfaces`` lists a file that does not exist, or is not an interface.

    **Why.** CMake stops: ``the passed file 'msg/Bet.msg' doesn't exist``. For a file next to
    CMakeLists.txt it complains of ``get_filename_component``: the path must start with a directory.

    **Fix.** Write the path of the file relative to CMakeLists.txt; it ends in .msg, .srv, .action
    or .idl.

    **Source.** ``rosidl_cmake/cmake/rosidl_generate_interfaces.cmake``.
    """

    code = "CM061"
    name = "interface-file-missing"
    examples = (
        Example(
            "it exists, or is made by the build",
            {
                "CMakeLists.txt": _LISTS % "msg/Beat.msg ${CMAKE_CURRENT_BINARY_DIR}:msg/Made.msg",
                "msg/Beat.msg": "int32 count\n",
            },
        ),
        Example(
            "misspelled, without its directory",
            {
                "CMakeLists.txt": _LISTS % "\n  msg/beat.msg\n  Beat.msg\n",
                "msg/Beat.msg": "int32 count\n",
            },
            Report(
                "CMakeLists.txt:3:3",
                "there is no file 'msg/beat.msg', so CMake stops; did you mean 'msg/Beat.msg'?",
            ),
            Report(
                "CMakeLists.txt:4:3",
                "there is no file 'Beat.msg', so CMake stops; did you mean 'msg/Beat.msg'?",
            ),
        ),
        Example(
            "next to CMakeLists.txt",
            {"CMakeLists.txt": _LISTS % "Beat.msg", "Beat.msg": "int32 count\n"},
            Report(
                "CMakeLists.txt:2:11",
                "Beat.msg must be in a directory, so CMake stops: move it to msg/",
            ),
        ),
        Example(
            "another kind of file",
            {"CMakeLists.txt": _LISTS % "msg/Beat.txt", "msg/Beat.txt": ""},
            Report("CMakeLists.txt:2:11", "msg/Beat.txt is not a .msg, .srv, .action or .idl file"),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        there = [path for path in package.files if path.rpartition(".")[2] in {*SECTIONS, "idl"}]
        made = [command.values for command in package.cmake.find("configure_file", "file")]
        for call in generations(package):
            for file in call.files:
                path, ending = file.path, file.path.rpartition(".")[2]
                if package.has(path) and ending not in {*SECTIONS, "idl"}:
                    message = f"{path} is not a .msg, .srv, .action or .idl file"
                    yield self.report(file.argument, message)
                elif package.has(path) and "/" not in path:
                    message = f"{path} must be in a directory, so CMake stops: move it to {ending}/"
                    yield self.report(file.argument, message)
                elif not package.has(path) and not any(path in values for values in made):
                    same = [item for item in there if item.lower().endswith(f"/{path.lower()}")]
                    hint = f"; did you mean {same[0]!r}?" if same else closest_word(path, there)
                    message = f"there is no file {path!r}, so CMake stops{hint}"
                    yield self.report(file.argument, message)
