"""PX017: the name in package.xml matches the other files."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Edit, Example, Fix, Package, Report, Rule, Safety
from scaffold.api.manifest import name_used_elsewhere

_MANIFEST = '<package format="3">\n  <name>{}</name>\n</package>\n'
_FILES = {"CMakeLists.txt": "project(talker)\n", "talker/__init__.py": ""}


class NameDiffersFromFiles(Rule):
    """The name in package.xml differs from the name in all other files.

    **Why.** ``ament_package()`` stops the build; for ament_python, ``ros2 run`` finds no
    executables, because they are installed under the other name.

    **Fix.** Use the name in the build file and the directories.

    **Source.** ``ament_cmake_core/cmake/core/ament_package_xml.cmake``;
    ``colcon_ros/task/ament_python/build.py``.
    """

    code = "PX017"
    name = "name-differs-from-files"
    examples = (
        Example("one name", {**_FILES, "package.xml": _MANIFEST.format("talker")}),
        Example(
            "renamed only in package.xml",
            {**_FILES, "package.xml": _MANIFEST.format("robot_talker")},
            Report(
                "package.xml:2:9",
                "the name is 'robot_talker', but 'talker' in CMakeLists.txt and other files",
                unsafe_fix="Replace with talker",
            ),
            fixed={"package.xml": _MANIFEST.format("talker")},
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        other = name_used_elsewhere(package)
        element = package.manifest.one("name")
        if other is None or element is None:
            return
        where = "CMakeLists.txt" if package.has("CMakeLists.txt") else "setup.py"
        message = f"the name is {element.text!r}, but {other!r} in {where} and other files"
        edit = Edit("package.xml", *element.text_span, other)
        fix = Fix(f"Replace with {other}", (edit,), Safety.UNSAFE)
        yield self.report(element.text_location, message, fix)
