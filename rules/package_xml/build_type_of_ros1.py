"""PX082: packages of ament say so."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Edit, Example, Fix, Package, Report, Rule, ViewError
from scaffold.api.cmake import uses_ament

_MANIFEST = (
    '<package format="3">\n  <name>talker</name>\n'
    "  <export>\n    <build_type>{}</build_type>\n  </export>\n</package>\n"
)
_SETUP = {"setup.py": "from setuptools import setup\n\nsetup(name='talker')\n"}


class BuildTypeOfRos1(Rule):
    """The build type is ``catkin`` or ``cmake``, but the files are those of ament.

    **Why.** colcon builds it without the hooks of ament, or finds no CMakeLists.txt: ``ros2 run``
    answers ``Package 'talker' not found``.

    **Fix.** ``<build_type>ament_cmake</build_type>``, or ``ament_python`` with a setup.py.

    **Source.** ``colcon_ros/task``; REP 149, ``build_type``.
    """

    code = "PX082"
    name = "build-type-of-ros1"
    examples = (
        Example("ament", {"package.xml": _MANIFEST.format("ament_python"), **_SETUP}),
        Example(
            "catkin",
            {"package.xml": _MANIFEST.format("catkin"), **_SETUP},
            Report(
                "package.xml:4:5",
                "build type catkin, but the files are those of ament_python",
                fix="write ament_python",
            ),
            fixed={"package.xml": _MANIFEST.format("ament_python")},
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        manifest = package.manifest
        elements = [one for one in manifest.root.descendants() if one.tag == "build_type"]
        given = manifest.build_type or ""
        if given not in {"catkin", "cmake"} or len(elements) != 1 or elements[0].get("condition"):
            return
        wanted = _wanted(package)
        if wanted:
            element = elements[0]
            start = manifest.source.text.find(given, element.start)
            edit = Edit("package.xml", start, start + len(given), wanted)
            message = f"build type {given}, but the files are those of {wanted}"
            yield self.report(element, message, Fix(f"write {wanted}", (edit,)))


def _wanted(package: Package) -> str:
    if package.has("CMakeLists.txt"):
        try:
            is_ament = uses_ament(package) and "catkin" not in package.cmake.source.text
        except ViewError:
            return ""
        return "ament_cmake" if is_ament else ""
    return "ament_python" if package.has("setup.py") else ""
