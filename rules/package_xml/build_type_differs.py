"""PX013: the build type fits the files."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Edit, Example, Fix, Package, Report, Rule

FILES = {"ament_cmake": "CMakeLists.txt", "cmake": "CMakeLists.txt", "ament_python": "setup.py"}


class BuildTypeDiffers(Rule):
    """``<build_type>`` wants a file that the package does not have.

    **Why.** The build stops: ``does not appear to contain CMakeLists.txt``, or ``setup.py``.

    **Fix.** Declare the build type that the files belong to.

    **Source.** ``colcon_ros/task``; REP-149, ``<build_type>``.
    """

    code = "PX013"
    name = "build-type-differs"
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
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
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
