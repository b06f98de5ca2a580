"""CM004: ``ament_package()`` is called once."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule


class AmentPackageRepeated(Rule):
    """``ament_package()`` is called twice.

    **Why.** It writes the index entry and the configuration files again, with what was collected
    up to there: which one is installed depends on the order.

    **Fix.** Keep the last call.

    **Source.** ROS 2 documentation, "ament_cmake user documentation": "exactly once".
    """

    code = "CM004"
    name = "ament-package-repeated"
    examples = (
        Example("once", {"CMakeLists.txt": "project(talker)\nament_package()\n"}),
        Example(
            "in two branches",
            {
                "CMakeLists.txt": "project(talker)\n"
                "if(WIN32)\n  ament_package()\n  return()\nendif()\nament_package()\n"
            },
        ),
        Example(
            "twice",
            {"CMakeLists.txt": "project(talker)\nament_package()\nament_package()\n"},
            Report("3:1", "ament_package() is already called in line 2"),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        calls = [call for call in package.cmake.find("ament_package") if not call.blocks]
        for call in calls[1:]:
            line = calls[0].location.line
            yield self.report(
                call.name_location, f"ament_package() is already called in line {line}"
            )
