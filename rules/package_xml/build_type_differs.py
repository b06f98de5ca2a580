"""PX013: the build type fits the files."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Edit, Effect, Example, Fix, Package, Report, Rule, ViewError
from scaffold.api.cmake import uses_ament

_MANIFEST = (
    '<package format="3">\n  <name>talker</name>\n'
    "  <export>\n    <build_type>{}</build_type>\n  </export>\n</package>\n"
)
_FILES = {"setup.py": "from setuptools import setup\n\nsetup(name='talker')\n"}
FILES = {"ament_cmake": "CMakeLists.txt", "cmake": "CMakeLists.txt", "ament_python": "setup.py"}


class BuildTypeDiffers(Rule):
    """``<build_type>`` does not match the files of the package.

    **Why.** The build stops: ``does not appear to contain CMakeLists.txt``, or ``setup.py``. With
    ``catkin`` or ``cmake``, colcon builds without the hooks of ament: ``ros2 run`` answers
    ``Package 'talker' not found``.

    **Fix.** Declare the build type that the files belong to.

    **Source.** ``colcon_ros/task``; REP-149, ``<build_type>``.
    """

    code = "PX013"
    name = "build-type-differs"
    effect = Effect.STOPS_BUILD
    examples = (
        Example(
            "a setup.py and ament_python",
            {
                "package.xml": "<package><export><build_type>ament_python</build_type></export>"
                "</package>\n",
                "setup.py": "",
            },
        ),
        Example(
            "a setup.py and ament_cmake",
            {
                "package.xml": "<package><export>\n"
                "  <build_type>ament_cmake</build_type>\n"
                "</export></package>\n",
                "setup.py": "",
            },
            Report(
                "package.xml:2:15",
                "build type ament_cmake needs a CMakeLists.txt, which the package "
                "does not have; its setup.py belongs to ament_python",
                fix="write ament_python",
            ),
            fixed={
                "package.xml": "<package><export>\n"
                "  <build_type>ament_python</build_type>\n"
                "</export></package>\n"
            },
        ),
        Example("ament", {"package.xml": _MANIFEST.format("ament_python"), **_FILES}),
        Example(
            "catkin",
            {"package.xml": _MANIFEST.format("catkin"), **_FILES},
            Report(
                "package.xml:4:5",
                "build type catkin, but the files are those of ament_python",
                fix="write ament_python",
            ),
            fixed={"package.xml": _MANIFEST.format("ament_python")},
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for diagnostic in self._check_ros1(package):
            yield diagnostic
            return
        for element in package.manifest.build_type_elements:
            wanted = FILES.get(element.text)
            if wanted is None or package.has(wanted) or element.get("condition"):
                continue
            message = f"build type {element.text} needs a {wanted}, which the package does not have"
            other = "ament_cmake" if wanted == "setup.py" else "ament_python"
            if not package.has(FILES[other]):
                yield self.report(element.text_location, message)
                continue
            edit = Edit("package.xml", *element.text_span, other)
            message += f"; its {FILES[other]} belongs to {other}"
            yield self.report(element.text_location, message, Fix(f"write {other}", (edit,)))

    def _check_ros1(self, package: Package) -> Iterator[Diagnostic]:
        """Report ``catkin`` and ``cmake`` where the files are those of ament."""
        manifest = package.manifest
        elements = [x for x in manifest.root.descendants() if x.tag == "build_type"]
        given = manifest.build_type or ""
        if given not in {"catkin", "cmake"} or len(elements) != 1 or elements[0].get("condition"):
            return
        wanted = _ament_type(package)
        if wanted:
            element = elements[0]
            start = manifest.source.text.find(given, element.start)
            edit = Edit("package.xml", start, start + len(given), wanted)
            message = f"build type {given}, but the files are those of {wanted}"
            yield self.report(element, message, Fix(f"write {wanted}", (edit,)))


def _ament_type(package: Package) -> str:
    """Return the build type that the files belong to; empty if they are not of ament."""
    if package.has("CMakeLists.txt"):
        try:
            is_ament = uses_ament(package) and "catkin" not in package.cmake.source.text
        except ViewError:
            return ""
        return "ament_cmake" if is_ament else ""
    return "ament_python" if package.has("setup.py") else ""
