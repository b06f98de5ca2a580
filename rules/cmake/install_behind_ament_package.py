"""CM007: installs come before ``ament_package()``."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule, Severity

_INSTALL = "install(DIRECTORY launch DESTINATION share/${PROJECT_NAME})\n"


class InstallBehindAmentPackage(Rule):
    """``install()`` comes after ``ament_package()``.

    **Why.** It works, but ``ament_package()`` has to be the last call: what comes later is not
    seen by the hooks that run there.

    **Fix.** Move ``ament_package()`` to the end.

    **Source.** ROS 2 documentation, "Developing a ROS 2 package".
    """

    code = "CM007"
    name = "install-behind-ament-package"
    severity = Severity.INFO
    examples = (
        Example("before", {"CMakeLists.txt": f"project(talker)\n{_INSTALL}ament_package()\n"}),
        Example(
            "after",
            {"CMakeLists.txt": f"project(talker)\nament_package()\n{_INSTALL}{_INSTALL}"},
            Report("CMakeLists.txt:3:1", "comes after ament_package() in line 2, like 1 more"),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        cmake = package.cmake
        calls = [call for call in cmake.find("ament_package") if not call.blocks]
        if not calls:
            return
        behind = [one for one in cmake.find("install") if one.index > calls[0].index]
        for command in behind[:1]:
            line = calls[0].location.line
            more = f", like {len(behind) - 1} more" if len(behind) > 1 else ""
            message = f"comes after ament_package() in line {line}{more}"
            yield self.report(command.name_location, message)
