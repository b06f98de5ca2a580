"""CM015: nothing is installed outside of the workspace."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule
from scaffold.api.cmake import Command

_LISTS = "project(talker)\ninstall(DIRECTORY launch DESTINATION {})\n"


class AbsoluteDestination(Rule):
    """``install`` writes to an absolute path.

    **Why.** The files leave the workspace: ``ros2`` does not find them, the build needs rights
    that it should not have, and a Debian package cannot be made.

    **Fix.** Give a path relative to the prefix, such as ``share/${PROJECT_NAME}``.

    **Source.** CMake documentation, ``install``.
    """

    code = "CM015"
    name = "absolute-destination"
    examples = (
        Example("relative", {"CMakeLists.txt": _LISTS.format("share/${PROJECT_NAME}")}),
        Example(
            "only if somebody asks for it",
            {
                "CMakeLists.txt": "project(talker)\nif(INSTALL_UDEV_RULES)\n"
                "  install(FILES talker.rules DESTINATION /etc/udev/rules.d)\nendif()\n"
            },
        ),
        Example(
            "absolute",
            {"CMakeLists.txt": _LISTS.format("/opt/talker/share")},
            Report("2:38", "installs to /opt/talker/share, outside of the workspace"),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for install in package.cmake.installs:
            argument = install.destination_argument
            if argument is None or not (install.destination or "").startswith("/"):
                continue
            if package.build_type == "ament_cmake" and not _is_asked_for(install.command):
                message = f"installs to {install.destination}, outside of the workspace"
                yield self.report(argument, message)


def _is_asked_for(command: Command) -> bool:
    """Tell whether a condition opts in, such as one for Debian packages."""
    at = command.parent
    while at is not None and at.name != "if":
        at = at.parent
    return at is not None
