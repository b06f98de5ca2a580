"""PX012: the build type exists."""

from __future__ import annotations

from collections.abc import Iterator
from difflib import get_close_matches

from scaffold.api import Diagnostic, Edit, Example, Fix, Package, Report, Rule

KNOWN = ("ament_cmake", "ament_python", "cmake", "catkin", "ament_cargo", "python")


class BuildTypeUnknown(Rule):
    """``<build_type>`` is misspelled.

    **Why.** colcon has no task for it: the package is skipped or built by the wrong one.

    **Fix.** Write ``ament_cmake``, ``ament_python`` or ``cmake``.

    **Source.** REP-149, ``<build_type>``; ``colcon_ros`` extension points.
    """

    code = "PX012"
    name = "build-type-unknown"
    examples = (
        Example(
            "known",
            {"package.xml": "<package><export><build_type>cmake</build_type></export></package>\n"},
        ),
        Example(
            "misspelled",
            {
                "package.xml": "<package><export>\n"
                "  <build_type>ament_pyton</build_type>\n"
                "</export></package>\n"
            },
            Report(
                "2:15",
                "unknown build type 'ament_pyton': colcon skips the package; "
                "closest: 'ament_python'",
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
            closest = get_close_matches(element.text, KNOWN, n=1, cutoff=0.75)
            if element.text in KNOWN or not closest:
                continue
            message = (
                f"unknown build type {element.text!r}: colcon skips the package; closest: "
                f"{closest[0]!r}"
            )
            edit = Edit("package.xml", *element.text_span, closest[0])
            yield self.report(element.text_location, message, Fix(f"write {closest[0]}", (edit,)))
