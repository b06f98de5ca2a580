"""CM001: ``project()`` has the name of the package, and languages that CMake supports."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Edit, Effect, Example, Fix, Package, Report, Rule, closest_name
from scaffold.api.cmake import uses_ament
from scaffold.api.manifest import name_used_elsewhere

_LISTS = (
    "cmake_minimum_required(VERSION 3.8)\n{}find_package(ament_cmake REQUIRED)\nament_package()\n"
)
_LISTS_LANGUAGE = "project(talker {})\nament_package()\n"
_LANGUAGES = frozenset(
    {"NONE", "ASM", "ASM-ATT", "ASM_MARMASM", "ASM_MASM", "ASM_NASM", "C", "CSharp", "CUDA", "CXX"}
    | {"Fortran", "HIP", "ISPC", "Java", "OBJC", "OBJCXX", "RC", "Swift"}
)
_MEANT = {"C++": "CXX", "CPP": "CXX", "PYTHON": "NONE"}
_ONE_VALUE = frozenset({"VERSION", "COMPAT_VERSION", "DESCRIPTION", "HOMEPAGE_URL"})
_MANIFEST = '<package format="3">\n  <name>talker</name>\n</package>\n'


class ProjectNameDiffers(Rule):
    """``project()`` is missing, differs from the package name, or has an unknown language.

    **Why.** ``ament_package()`` stops the build unless both names are the same; without a call, the
    name is ``Project``. An unknown language such as Python stops it, too: ``Could not find cmake
    module file: CMakeDeterminePYTHONCompiler.cmake``.

    **Fix.** Write ``project(<name in package.xml>)`` after ``cmake_minimum_required``; the language
    is ``NONE`` for a pure Python package, ``CXX`` for C++.

    **Source.** ``ament_cmake_core/cmake/core/ament_package_xml.cmake``; CMake documentation,
    ``project`` and ``enable_language``.
    """

    code = "CM001"
    name = "project-name-differs"
    effect = Effect.STOPS_BUILD
    examples = (
        Example(
            "without a name",
            {"CMakeLists.txt": _LISTS.format("")},
            "1:1: no project(): CMake stops at ament_package()",
        ),
        Example(
            "a language", {"CMakeLists.txt": _LISTS_LANGUAGE.format("VERSION 1.0 LANGUAGES C CXX")}
        ),
        Example("no language, short form", {"CMakeLists.txt": _LISTS_LANGUAGE.format("NONE")}),
        Example(
            "a language in a variable",
            {"CMakeLists.txt": _LISTS_LANGUAGE.format("LANGUAGES ${LANGUAGES}")},
        ),
        Example(
            "an unknown language",
            {"CMakeLists.txt": _LISTS_LANGUAGE.format("DESCRIPTION Talk LANGUAGES CPP PYTHON")},
            "1:43: unknown language 'CPP': CMake stops; did you mean 'CXX'?",
            "1:47: unknown language 'PYTHON': CMake stops; did you mean 'NONE'?",
        ),
        Example(
            "the name of the package",
            {"package.xml": _MANIFEST, "CMakeLists.txt": "project(talker)\n"},
        ),
        Example(
            "one of two projects",
            {
                "package.xml": _MANIFEST,
                "CMakeLists.txt": "if(SUPERBUILD)\n  project(all NONE)\n  return()\nelse()\n"
                "  project(talker)\nendif()\n",
            },
        ),
        Example(
            "another name",
            {"package.xml": _MANIFEST, "CMakeLists.txt": "project(listener)\n"},
            Report(
                "CMakeLists.txt:1:9",
                "project name 'listener' differs from package name 'talker' "
                "(package.xml, line 2): CMake stops",
                fix="Rename the project to talker",
            ),
            fixed={"CMakeLists.txt": "project(talker)\n"},
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        yield from self._check_call(package)
        yield from self._check_language(package)
        yield from self._check_name(package)

    def _check_call(self, package: Package) -> Iterator[Diagnostic]:
        cmake = package.cmake
        if cmake.project is None and cmake.commands and not cmake.includes_unknown:
            if not uses_ament(package):
                return
            message = f"no project({package.name}): CMake stops at ament_package()"
            yield self.report(cmake.commands[0].name_location, message)

    def _check_language(self, package: Package) -> Iterator[Diagnostic]:
        for command in package.cmake.find("project"):
            is_value = False
            for argument in command.arguments[1:]:
                if is_value or argument.value in _ONE_VALUE:
                    is_value = not is_value
                elif argument.value not in {*_LANGUAGES, "LANGUAGES"} and "$" not in argument.value:
                    closest = _MEANT.get(argument.value.upper(), "") or closest_name(
                        package, argument.value, _LANGUAGES, 0.6
                    )
                    hint = f"; did you mean {closest!r}?" if closest else ""
                    message = f"unknown language {argument.value!r}: CMake stops{hint}"
                    yield self.report(argument, message)

    def _check_name(self, package: Package) -> Iterator[Diagnostic]:
        name = package.manifest.name
        written = package.cmake.project_name
        at = package.cmake.project_name_location
        if not written or not name or at is None or written == name:
            return
        if package.build_type == "cmake" or name_used_elsewhere(package):
            return
        projects = [call.arguments[0] for call in package.cmake.find("project") if call.arguments]
        if any(package.cmake.expand(project) == name for project in projects):
            return  # the others are for other build systems
        line = package.manifest.all("name")[0].location.line
        message = (
            f"project name {written!r} differs from package name {name!r} (package.xml, "
            f"line {line}): CMake stops"
        )
        argument = package.cmake.find("project")[0].arguments[0]
        fix = None
        if argument.value == written and not argument.quoted:
            edit = Edit(argument.path, argument.start, argument.end, name)
            fix = Fix(f"Rename the project to {name}", (edit,))
        yield self.report(at, message, fix)
