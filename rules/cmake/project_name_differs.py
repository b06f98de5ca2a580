"""CM001: the project is named like the package."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Edit, Effect, Example, Fix, Package, Report, Rule
from scaffold.api.manifest import name_used_elsewhere

_MANIFEST = '<package format="3">\n  <name>talker</name>\n</package>\n'


class ProjectNameDiffers(Rule):
    """``project()`` does not name the package of package.xml.

    **Why.** ``ament_package()`` stops the build: the names must be the same.

    **Fix.** Write the name of package.xml in ``project()``.

    **Source.** ``ament_cmake_core/cmake/core/ament_package_xml.cmake``.
    """

    code = "CM001"
    name = "project-name-differs"
    effect = Effect.STOPS_BUILD
    examples = (
        Example("one name", {"package.xml": _MANIFEST, "CMakeLists.txt": "project(talker)\n"}),
        Example(
            "one of two",
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
                "the project is 'listener', the package 'talker' (package.xml, line 2)",
                fix="name the project talker",
            ),
            fixed={"CMakeLists.txt": "project(talker)\n"},
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        name = package.manifest.name
        written = package.cmake.project_name
        at = package.cmake.project_name_location
        if not written or not name or at is None or written == name:
            return
        if package.build_type == "cmake" or name_used_elsewhere(package):
            return
        projects = [call.arguments[0] for call in package.cmake.find("project") if call.arguments]
        if any(package.cmake.expand(project) == name for project in projects):
            return  # the others are for other ways to build it
        line = package.manifest.all("name")[0].location.line
        message = f"the project is {written!r}, the package {name!r} (package.xml, line {line})"
        argument = package.cmake.find("project")[0].arguments[0]
        fix = None
        if argument.value == written and not argument.quoted:
            edit = Edit("CMakeLists.txt", argument.start, argument.end, name)
            fix = Fix(f"name the project {name}", (edit,))
        yield self.report(at, message, fix)
