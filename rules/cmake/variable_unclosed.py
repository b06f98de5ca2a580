"""CM104: ``${`` is closed by ``}``."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Effect, Example, Package, Rule
from scaffold.api.cmake import Argument

_LISTS = (
    "project(talker)\ninstall(PROGRAMS talker/node.py\n"
    '  DESTINATION lib/{}\n)\nset(pattern [[a${{b]] "\\${{c" \'d$\' "@${{PROJECT_NAME}}")\n'
)


class VariableUnclosed(Rule):
    """A reference to a variable, ``${NAME}``, has no ``}``.

    **Why.** CMake stops: ``There is an unterminated variable reference``.

    **Fix.** Close it.

    **Source.** CMake documentation, "cmake-language", variable references.
    """

    code = "CM104"
    name = "variable-unclosed"
    effect = Effect.STOPS_BUILD
    examples = (
        Example(
            "closed", {"CMakeLists.txt": _LISTS.format("${PROJECT_NAME}"), "talker/node.py": ""}
        ),
        Example(
            "not closed",
            {"CMakeLists.txt": _LISTS.format("${PROJECT_NAME"), "talker/node.py": ""},
            "CMakeLists.txt:3:15: missing '}' in 'lib/${PROJECT_NAME': CMake stops",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for command in package.cmake.commands:
            for argument in command.arguments:
                if not argument.bracket and _is_open(argument):
                    message = f"missing '}}' in {argument.raw.splitlines()[0]!r}: CMake stops"
                    yield self.report(argument, message)


def _is_open(argument: Argument) -> bool:
    """Tell whether more references are opened than closed; escaped signs do not count."""
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
