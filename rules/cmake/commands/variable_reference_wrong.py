"""CM091: references to variables are closed, and PROJECT_NAME has its name."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping
from difflib import get_close_matches

from scaffold.api import Diagnostic, Edit, Example, Fix, Package, Report, Rule, Safety
from scaffold.api.cmake import Argument, CMakeLists

_SIMILAR = 0.6
"""Minimum similarity, from 0 to 1, between an undefined variable and one that is never read."""
_WANTED = "PROJECT_NAME"
_OTHERS = frozenset({"PACKAGE_NAME", "PKG_NAME", "PACKAGE", "PROJECT", "PROJECTNAME"})
_KNOWN = frozenset({"CMAKE_PROJECT_NAME", "PROJECT_NAME"})
_LISTS = "project(talker)\n{}install(FILES a.yaml DESTINATION share/${{{}}})\nament_package()\n"
_LISTS_CLOSED = (
    "project(talker)\ninstall(PROGRAMS talker/node.py\n"
    '  DESTINATION lib/{}\n)\nset(pattern [[a${{b]] "\\${{c" \'d$\' "@${{PROJECT_NAME}}")\n'
)


class VariableReferenceWrong(Rule):
    """A variable reference has no closing brace, or misspells PROJECT_NAME or another variable.

    **Why.** CMake stops: ``There is an unterminated variable reference``. An undefined variable is
    empty, without an error: files are installed to ``lib/`` or ``share/`` instead of the directory
    of the package, and a loop over it does nothing.

    **Fix.** Add the brace; write ``${PROJECT_NAME}``: CMake variables are case-sensitive.

    **Source.** CMake documentation, "cmake-language", variables and variable references.
    """

    code = "CM091"
    name = "variable-reference-wrong"
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
                fix="Replace with PROJECT_NAME",
            ),
            fixed={"CMakeLists.txt": _LISTS.format("", "PROJECT_NAME")},
        ),
        Example(
            "closed",
            {"CMakeLists.txt": _LISTS_CLOSED.format("${PROJECT_NAME}"), "talker/node.py": ""},
        ),
        Example(
            "not closed",
            {"CMakeLists.txt": _LISTS_CLOSED.format("${PROJECT_NAME"), "talker/node.py": ""},
            "CMakeLists.txt:3:15: missing '}' in 'lib/${PROJECT_NAME': CMake stops",
        ),
        Example(
            "a variable that a package sets",
            {
                "CMakeLists.txt": "project(talker)\nset(CMAKE_INCLUDE_CURRENT_DIR ON)\n"
                "find_package(rviz_ogre_vendor REQUIRED)\n"
                "include_directories(${OGRE_INCLUDE_DIRS})\nament_package()\n"
            },
        ),
        Example(
            "a misspelled list, and one with two names that are read",
            {
                "CMakeLists.txt": "project(talker)\nset(scripts a.py)\nset(nodes b.py)\n"
                "install(PROGRAMS ${script_files} DESTINATION lib/talker)\n"
                "install(PROGRAMS ${node_files} ${nodes} DESTINATION lib/talker)\n",
                "a.py": "",
                "b.py": "",
            },
            Report(
                "CMakeLists.txt:4:18",
                "script_files is never set, so it is empty; did you mean ${scripts}?",
                unsafe_fix="Replace with scripts",
            ),
            fixed={
                "CMakeLists.txt": "project(talker)\nset(scripts a.py)\nset(nodes b.py)\n"
                "install(PROGRAMS ${scripts} DESTINATION lib/talker)\n"
                "install(PROGRAMS ${node_files} ${nodes} DESTINATION lib/talker)\n",
            },
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        yield from self._check_closed(package)
        cmake = package.cmake
        if cmake.includes_unknown or cmake.find("add_subdirectory"):
            return
        values = Counter(value for command in cmake.commands for value in command.values)
        for command in cmake.commands:
            for argument in command.arguments:
                for name in _variables(argument):
                    if name in values or _is_made(cmake, name):
                        continue
                    meant = _WANTED if _is_meant(name) else _unread(cmake, name, values)
                    if meant:
                        yield self._report(argument, name, meant)

    def _report(self, argument: Argument, name: str, meant: str) -> Diagnostic:
        fix = None
        at = argument.raw.find(f"${{{name}}}")
        if at >= 0:
            start = argument.start + at + 2
            edit = Edit(argument.path, start, start + len(name), meant)
            safety = Safety.SAFE if meant == _WANTED else Safety.UNSAFE
            fix = Fix(f"Replace with {meant}", (edit,), safety)
        message = f"{name} is never set, so it is empty; did you mean ${{{meant}}}?"
        return self.report(argument, message, fix)

    def _check_closed(self, package: Package) -> Iterator[Diagnostic]:
        for command in package.cmake.commands:
            for argument in command.arguments:
                if not argument.bracket and _is_open(argument):
                    message = f"missing '}}' in {argument.raw.splitlines()[0]!r}: CMake stops"
                    yield self.report(argument, message)


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


def _unread(cmake: CMakeLists, name: str, values: Mapping[str, int]) -> str:
    """Return the most similar variable that is set, if it is never read; empty without one.

    ``values`` counts the values of all arguments.
    """
    if not name.islower():
        return ""  # packages set variables with capitals, such as Eigen3_INCLUDE_DIRS
    given = [command.values[0] for command in cmake.find("set", "option") if command.values]
    given += [command.values[1] for command in cmake.find("file", "list") if command.values[1:]]
    closest = get_close_matches(name, {*given}, 1, _SIMILAR)
    if not closest or values[closest[0]] != 1:
        return ""
    is_read = any(f"{{{closest[0]}}}" in value for value in values)
    return "" if is_read else closest[0]


def _is_made(cmake: CMakeLists, name: str) -> bool:
    """Return whether a variable is a parameter of a function or a loop variable."""
    return any(name in command.values for command in cmake.find("function", "macro", "foreach"))


def _is_open(argument: Argument) -> bool:
    """Return whether a reference is not closed; escaped characters do not count."""
    text = argument.text
    if "${" not in text:
        return False
    depth, at = 0, 0
    while at < len(text):
        if text[at] == "\\":
            at += 2
        elif text.startswith("${", at) or text.startswith("$ENV{", at):
            depth += 1
            at = text.index("{", at) + 1
        else:
            if text[at] == "}" and depth:
                depth -= 1
            at += 1
    return depth > 0
