"""PX011: the manifest says how the package is built."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Edit, Example, Fix, Package, Report, Rule

_CMAKE_PACKAGE = "find_package(ament_cmake REQUIRED)\nament_package()\n"


class BuildTypeMissing(Rule):
    """``<export>`` has no ``<build_type>``.

    **Why.** colcon then takes the package for one of ROS 1, of build type catkin: it is built
    without the ament hooks, and ``ros2 run`` answers ``Package not found``; one with only a
    setup.py does not build at all.

    **Fix.** Add ``<build_type>ament_cmake</build_type>`` or ``ament_python``.

    **Source.** REP-149, ``<build_type>``: the default is catkin.
    """

    code = "PX011"
    name = "build-type-missing"
    examples = (
        Example(
            "declared",
            {
                "package.xml": "<package><export><build_type>ament_python</build_type></export>"
                "</package>\n",
                "setup.py": "",
            },
        ),
        Example(
            "a setup.py, and no build type",
            {"package.xml": "<package>\n  <name>talker</name>\n</package>\n", "setup.py": ""},
            Report(
                "package.xml:1:2",
                "no <build_type>: colcon treats the package as catkin; write "
                "<build_type>ament_python</build_type> in <export>",
                fix="declare ament_python",
            ),
            fixed={
                "package.xml": "<package>\n"
                "  <name>talker</name>\n"
                "  <export>\n"
                "    <build_type>ament_python</build_type>\n"
                "  </export>\n"
                "</package>\n"
            },
        ),
        Example(
            "an export for something else",
            {
                "package.xml": "<package>\n  <export>\n    <other/>\n  </export>\n</package>\n",
                "CMakeLists.txt": _CMAKE_PACKAGE,
            },
            Report(
                "package.xml:2:4",
                "no <build_type>: colcon treats the package as catkin; write "
                "<build_type>ament_cmake</build_type> in <export>",
                fix="declare ament_cmake",
            ),
            fixed={
                "package.xml": "<package>\n  <export>\n"
                "    <build_type>ament_cmake</build_type>\n    <other/>\n  </export>\n</package>\n"
            },
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        manifest = package.manifest
        if manifest.build_type_elements or "catkin" in manifest.declared_names:
            return
        if package.has("CMakeLists.txt"):
            uses_ament = any(name.startswith("ament_") for name in manifest.declared_names) or any(
                command.name.startswith("ament_") for command in package.cmake.commands
            )
            if not uses_ament:
                return
            build_type = "ament_cmake"
        elif package.has("setup.py"):
            build_type = "ament_python"
        else:
            return
        export = manifest.one("export")
        line = f"<build_type>{build_type}</build_type>"
        newline = manifest.source.newline
        if export is None:
            close = manifest.root.close_start
            text = f"  <export>{newline}    {line}{newline}  </export>{newline}"
            at, edit = manifest.root.name_location, Edit("package.xml", close, close, text)
        else:
            inside = export.open_end
            at = export.name_location
            edit = Edit("package.xml", inside, inside, f"{newline}    {line}")
        message = f"no <build_type>: colcon treats the package as catkin; write {line} in <export>"
        fix = Fix(f"declare {build_type}", (edit,)) if export is None or export.children else None
        yield self.report(at, message, fix)
