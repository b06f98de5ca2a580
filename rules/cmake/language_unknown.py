"""CM111: CMake knows the languages of the project."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Effect, Example, Package, Report, Rule, closest_name

_LISTS = "project(talker {})\nament_package()\n"
_LANGUAGES = frozenset(
    {"NONE", "ASM", "ASM-ATT", "ASM_MARMASM", "ASM_MASM", "ASM_NASM", "C", "CSharp", "CUDA", "CXX"}
    | {"Fortran", "HIP", "ISPC", "Java", "OBJC", "OBJCXX", "RC", "Swift"}
)
_MEANT = {"C++": "CXX", "CPP": "CXX", "PYTHON": "NONE"}
_ONE_VALUE = frozenset({"VERSION", "COMPAT_VERSION", "DESCRIPTION", "HOMEPAGE_URL"})


class LanguageUnknown(Rule):
    """``project()`` names a language that CMake does not have, such as Python.

    **Why.** CMake stops: ``Could not find cmake module file: CMakeDeterminePYTHONCompiler.cmake``.

    **Fix.** ``NONE`` for a package of Python alone, ``CXX`` for C++; CMake does not compile Python.

    **Source.** CMake documentation, ``project`` and ``enable_language``.
    """

    code = "CM111"
    name = "language-unknown"
    effect = Effect.STOPS_BUILD
    examples = (
        Example("known", {"CMakeLists.txt": _LISTS.format("VERSION 1.0 LANGUAGES C CXX")}),
        Example("none, in short", {"CMakeLists.txt": _LISTS.format("NONE")}),
        Example("a variable", {"CMakeLists.txt": _LISTS.format("LANGUAGES ${LANGUAGES}")}),
        Example(
            "unknown",
            {"CMakeLists.txt": _LISTS.format("DESCRIPTION Talk LANGUAGES CPP PYTHON")},
            Report("1:43", "CMake has no language 'CPP': it stops; closest: 'CXX'"),
            Report("1:47", "CMake has no language 'PYTHON': it stops; closest: 'NONE'"),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for command in package.cmake.find("project"):
            is_value = False
            for argument in command.arguments[1:]:
                if is_value or argument.value in _ONE_VALUE:
                    is_value = not is_value
                elif argument.value not in {*_LANGUAGES, "LANGUAGES"} and "$" not in argument.value:
                    closest = _MEANT.get(argument.value.upper(), "") or closest_name(
                        package, argument.value, _LANGUAGES, 0.6
                    )
                    hint = f"; closest: {closest!r}" if closest else ""
                    message = f"CMake has no language {argument.value!r}: it stops{hint}"
                    yield self.report(argument, message)
