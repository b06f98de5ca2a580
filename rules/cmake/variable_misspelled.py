"""CM091: the variable with the name of the package is PROJECT_NAME."""

from __future__ import annotations

from collections.abc import Iterator
from difflib import get_close_matches

from scaffold.api import Diagnostic, Edit, Example, Fix, Package, Report, Rule
from scaffold.api.cmake import Argument, CMakeLists

_WANTED = "PROJECT_NAME"
_OTHERS = frozenset({"PACKAGE_NAME", "PKG_NAME", "PACKAGE", "PROJECT", "PROJECTNAME"})
_KNOWN = frozenset({"CMAKE_PROJECT_NAME", "PROJECT_NAME"})
_LISTS = "project(talker)\n{}install(FILES a.yaml DESTINATION share/${{{}}})\nament_package()\n"


class VariableMisspelled(Rule):
    """An undefined variable is used instead of ``PROJECT_NAME``.

    **Why.** CMake silently treats it as empty: files are installed in ``lib/`` or
    ``share/`` instead of the directory of the package.

    **Fix.** Write ``${PROJECT_NAME}``; variables of CMake are case-sensitive.

    **Source.** CMake documentation, "cmake-language", variables.
    """

    code = "CM091"
    name = "variable-misspelled"
    examples = (
        Example(
            "set",
            {
                "CMakeLists.txt": _LISTS.format("set(PACKAGE_NAME talker)\n", "PACKAGE_NAME"),
                "a.yaml": "",
            },
        ),
        Example(
            "in lower case",
            {"CMakeLists.txt": _LISTS.format("", "project_name"), "a.yaml": ""},
            Report(
                "CMakeLists.txt:2:34",
                "project_name is never set, so it is empty; did you mean ${PROJECT_NAME}?",
                fix="write PROJECT_NAME",
            ),
            fixed={"CMakeLists.txt": _LISTS.format("", "PROJECT_NAME")},
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        cmake = package.cmake
        if cmake.find("include", "add_subdirectory"):
            return
        named = {value for command in cmake.commands for value in command.values}
        for command in cmake.commands:
            for argument in command.arguments:
                for name in _variables(argument):
                    if name not in named and _is_meant(name) and not _is_made(cmake, name):
                        yield self._report(argument, name)

    def _report(self, argument: Argument, name: str) -> Diagnostic:
        fix = None
        at = argument.raw.find(f"${{{name}}}")
        if at >= 0:
            start = argument.start + at + 2
            edit = Edit("CMakeLists.txt", start, start + len(name), _WANTED)
            fix = Fix(f"write {_WANTED}", (edit,))
        message = f"{name} is never set, so it is empty; did you mean ${{{_WANTED}}}?"
        return self.report(argument, message, fix)


def _variables(argument: Argument) -> Iterator[str]:
    """Yield the variables that an argument refers to."""
    for part in argument.text.split("${")[1:]:
        name, closed, _ = part.partition("}")
        if closed:
            yield name


def _is_meant(name: str) -> bool:
    if name in _KNOWN or name.startswith("CMAKE_"):
        return False
    close = get_close_matches(name.upper(), [_WANTED], 1, 0.85)
    return name in _OTHERS or name.upper() == _WANTED or bool(close)


def _is_made(cmake: CMakeLists, name: str) -> bool:
    """Tell whether a variable is a parameter of a function, or of a loop."""
    return any(name in command.values for command in cmake.find("function", "macro", "foreach"))
