"""UR001: the files and packages that URDF and xacro files name exist after installation."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule, Severity, closest_name
from scaffold.api.install import share_of
from scaffold.api.launch import NamedPath, Reference, exists, meant_package, missing_in, why_missing
from scaffold.api.manifest import declared, declaring
from scaffold.api.robot import NamedFile, named_files, robot_paths
from scaffold.api.workspace import is_untracked

_SETUP = (
    "from glob import glob\n\nfrom setuptools import setup\n\n"
    "setup(\n    name='talker',\n    data_files=[\n"
    "        ('share/talker', ['package.xml']),\n"
    "        ('share/talker/urdf', glob('urdf/*')),\n"
    "    ],\n)\n"
)
_MANIFEST = (
    '<package format="3">\n  <name>talker</name>\n'
    "  <export>\n    <build_type>ament_python</build_type>\n  </export>\n</package>\n"
)
_ROBOT = (
    '<robot name="robot" xmlns:xacro="http://www.ros.org/wiki/xacro">\n'
    '  <xacro:include filename="{}"/>\n'
    '  <link name="base_link">\n    <visual>\n'
    '      <geometry><mesh filename="{}"/></geometry>\n'
    "    </visual>\n  </link>\n</robot>\n"
)
_LARGE = (".stl", ".dae", ".obj", ".glb", ".gltf", ".png", ".jpg")
_FILES = {
    "package.xml": _MANIFEST,
    "setup.py": _SETUP,
    "urdf/wheel.xacro": "<robot/>\n",
    "urdf/base.stl": "",
}
_MANIFEST_PACKAGES = (
    '<package format="3">\n  <name>rover</name>\n'
    "  <exec_depend>turret_description</exec_depend>\n</package>\n"
)
_ROBOT_PACKAGES = (
    '<robot name="robot" xmlns:xacro="http://www.ros.org/wiki/xacro">\n'
    '  <xacro:include filename="$(find {})/urdf/wheel.xacro"/>\n  <link name="base_link"/>\n'
    "</robot>\n"
)


class FileNotThere(Rule):
    """A URDF or xacro file uses a file or a package that does not exist after installation.

    **Why.** xacro stops at an include with ``No such file or directory`` or ``package 'robopy' not
    found``, so the robot has no description; for a mesh, RViz shows ``Could not load resource`` and
    Gazebo nothing.

    **Fix.** Write the path that the build file installs, or install the file; write the name that
    is in package.xml, and declare the package.

    **Source.** xacro, ``process_include`` and ``substitution_args.py``; resource_retriever resolves
    ``package://``.
    """

    code = "UR001"
    name = "file-not-there"
    other_severities = {
        Severity.WARNING: "a mesh is missing next to others, and may be kept elsewhere; the "
        "file is not installed, and may be copied to where it is used; a condition in xacro "
        "decides; or the package exists, but is not declared"
    }
    examples = (
        Example(
            "installed",
            {
                **_FILES,
                "urdf/robot.xacro": _ROBOT.format(
                    "$(find talker)/urdf/wheel.xacro", "package://talker/urdf/base.stl"
                ),
            },
        ),
        Example(
            "next to the file; of a package that is not here",
            {
                **_FILES,
                "urdf/robot.xacro": _ROBOT.format("wheel.xacro", "package://other/base.stl"),
            },
        ),
        Example(
            "made by Bazel",
            {
                **_FILES,
                "urdf/BUILD.bazel": "",
                "urdf/arm.urdf.xacro": "<robot/>\n",
                "urdf/robot.xacro": _ROBOT.format("arm.urdf", "package://talker/urdf/base.stl"),
            },
        ),
        Example(
            "made by the build",
            {
                "package.xml": _MANIFEST.replace("ament_python", "ament_cmake"),
                "CMakeLists.txt": "project(talker)\nfind_package(ament_cmake REQUIRED)\n"
                "find_package(xacro REQUIRED)\n"
                "install(DIRECTORY urdf DESTINATION share/${PROJECT_NAME})\n"
                "xacro_add_files(urdf/arm.urdf.xacro TARGET arm INSTALL DESTINATION urdf)\n"
                "ament_package()\n",
                "urdf/arm.urdf.xacro": "<robot/>\n",
                "urdf/base.stl": "",
                "urdf/robot.xacro": _ROBOT.format(
                    "$(find talker)/urdf/arm.urdf", "package://talker/urdf/base.stl"
                ),
            },
        ),
        Example(
            "another name; another directory",
            {
                **_FILES,
                "urdf/robot.xacro": _ROBOT.format(
                    "$(find talker)/urdf/wheels.xacro", "package://talker/meshes/base.stl"
                ),
            },
            "urdf/robot.xacro:2:28: share/talker/urdf/wheels.xacro does not exist: talker has no "
            "such file; closest: urdf/wheel.xacro",
            "urdf/robot.xacro:5:33: share/talker/meshes/base.stl does not exist: it is installed "
            "as share/talker/urdf/base.stl",
        ),
        Example(
            "not next to the file",
            {**_FILES, "urdf/robot.xacro": _ROBOT.format("wheels.xacro", "file:///base.stl")},
            "urdf/robot.xacro:2:28: urdf/wheels.xacro does not exist: xacro stops with 'No such "
            "file'; closest: 'wheel.xacro'",
        ),
        Example(
            "a mesh next to another",
            {
                **_FILES,
                "urdf/robot.xacro": _ROBOT.format("wheel.xacro", "package://talker/urdf/top.stl"),
            },
            Report(
                "urdf/robot.xacro:5:33",
                "share/talker/urdf/top.stl does not exist: talker has no such file; "
                "closest: urdf/base.stl",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "two templates that are not installed: one cause",
            {
                **_FILES,
                **dict.fromkeys(
                    ("batch/a/robot.xacro", "batch/b/robot.xacro"),
                    _ROBOT.format("parts/wheels.xacro", "file:///base.stl"),
                ),
            },
            Report(
                "batch/a/robot.xacro:2:28",
                "batch/a/parts/wheels.xacro does not exist: xacro stops with 'No "
                "such file'; closest: 'wheel.xacro'",
                severity=Severity.WARNING,
            ),
            Report(
                "batch/b/robot.xacro:2:28",
                "batch/b/parts/wheels.xacro does not exist: xacro stops with 'No "
                "such file'; closest: 'wheel.xacro'",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "of a submodule of git, which a clone may not have",
            {
                **_FILES,
                ".gitmodules": '[submodule "arm"]\n\tpath = urdf/arm\n\turl = ../arm.git\n',
                "urdf/robot.xacro": _ROBOT.format("arm/arm.xacro", "file:///base.stl"),
            },
        ),
        Example(
            "for one of several arms",
            {
                **_FILES,
                "urdf/robot.xacro": _ROBOT.format("$(find talker)/urdf/lift.xacro", "file:///a.stl")
                .replace(
                    "<xacro:inc",
                    '<xacro:arg name="lift" default=""/>'
                    '<xacro:if value="$(arg lift)">\n  <xacro:inc',
                )
                .replace('lift.xacro"/>', 'lift.xacro"/></xacro:if>'),
            },
            Report(
                "urdf/robot.xacro:3:28",
                "share/talker/urdf/lift.xacro does not exist: talker has no such file; closest: "
                "urdf/wheel.xacro",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "nothing like it",
            {**_FILES, "urdf/robot.xacro": _ROBOT.format("parts/laser.xacro", "file:///base.stl")},
            "urdf/robot.xacro:2:28: urdf/parts/laser.xacro does not exist: xacro stops with 'No "
            "such file'",
        ),
        Example(
            "a package that is declared; one that is not known",
            {
                "package.xml": _MANIFEST_PACKAGES,
                "a.xacro": _ROBOT_PACKAGES.format("turret_description"),
                "b.xacro": _ROBOT_PACKAGES.format("my_arm"),
            },
        ),
        Example(
            "a package that is not declared",
            {
                "package.xml": _MANIFEST_PACKAGES,
                "a.xacro": _ROBOT_PACKAGES.format("realsense2_description"),
            },
            Report(
                "a.xacro:2:28",
                "needs 'realsense2_description', which no dependency in package.xml "
                "provides; add <exec_depend>realsense2_description</exec_depend>",
                fix="Declare realsense2_description",
                severity=Severity.WARNING,
            ),
            fixed={
                "package.xml": _MANIFEST_PACKAGES.replace(
                    "  <exec", "  <exec_depend>realsense2_description</exec_depend>\n  <exec", 1
                )
            },
        ),
        Example(
            "a package with nearly the name of one that is declared",
            {
                "package.xml": _MANIFEST_PACKAGES,
                "a.xacro": _ROBOT_PACKAGES.format("turet_description"),
            },
            "a.xacro:2:28: unknown package 'turet_description'; did you mean 'turret_description' "
            "(which package.xml declares)?",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        yield from self._check_files(package)
        yield from self._check_packages(package)

    def _check_files(self, package: Package) -> Iterator[Diagnostic]:
        for named in named_files(package):
            if named.package:
                path = NamedPath(named.package, named.path, named.location)
                why = why_missing(package, path)
                if why is not None:
                    message = f"share/{path.package}/{path.path} does not exist: {why}"
                    is_data = _may_be_kept_elsewhere(package, named)
                    severity = Severity.WARNING if is_data else _severity(package, named)
                    cause = missing_in(package, path)
                    yield self.report(named, message, severity=severity, cause=cause)
            elif not _is_there(package, named):
                name = named.path.rpartition("/")[2]
                names = [item.rpartition("/")[2] for item in robot_paths(package)]
                closest = closest_name(package, name, names, 0.7)
                hint = f"; closest: {closest!r}" if closest else ""
                message = f"{named.path} does not exist: xacro stops with 'No such file'{hint}"
                severity = _severity(package, named)
                yield self.report(named, message, severity=severity, cause=f"missing {name}")

    def _check_packages(self, package: Package) -> Iterator[Diagnostic]:
        manifest = package.manifest
        dependencies = declared(package, for_tests=False)
        seen = {package.name, *dependencies.direct, *dependencies.along, *manifest.declared_names}
        for named in named_files(package):
            if not named.package or not package.has("package.xml"):
                continue
            use = Reference(named.package, named.location, None, named.location)
            meant = meant_package(package, use)
            if meant is not None:
                message = (
                    f"unknown package {named.package!r}; did you mean {meant.name!r} "
                    f"({meant.reason})?"
                )
                yield self.report(named, message)
            elif named.package not in seen and exists(package, named.package):
                seen.add(named.package)
                tag = "exec_depend" if manifest.format > 1 else "run_depend"
                needed = declaring(package, tag, named.package)
                yield self.report(
                    named,
                    f"needs {named.package!r}, which no dependency in package.xml provides; "
                    f"{needed.advice}",
                    needed.fix,
                    severity=Severity.WARNING,
                    cause=f"dependency {named.package}",
                )


def _severity(package: Package, named: NamedFile) -> Severity:
    """Return the severity of a missing file: higher if the referring file is always used."""
    share = share_of(package)
    is_used = not share.complete or named.user in share.files.values()
    return Severity.ERROR if is_used and named.is_certain else Severity.WARNING


def _may_be_kept_elsewhere(package: Package, named: NamedFile) -> bool:
    """Tell whether a file is one of several large ones, which not every clone has."""
    owner = package if named.package == package.name else package.workspace.get(named.package)
    directory, _, name = named.path.rpartition("/")
    top = directory.partition("/")[0]
    files = owner.files if owner is not None else ()
    return (
        name.lower().endswith(_LARGE)
        and not any(path.rpartition("/")[2] == name for path in files)
        and any(path.startswith(f"{top}/") and path.lower().endswith(_LARGE) for path in files)
    )


def _is_there(package: Package, named: NamedFile) -> bool:
    """Tell whether a file is next to its user, or generated from one that is."""
    if package.has(named.path) or named.path.startswith(".."):
        return True
    if is_untracked(package, named.path):
        return True  # generated on each machine, or in a submodule
    if package.has(f"{named.path}.xacro") and _is_built_by_bazel(package, named.path):
        return True
    name = named.path.rpartition("/")[2]
    files = share_of(package).files
    return any(path.rpartition("/")[2] == name for path in (*files, *package.files))


def _is_built_by_bazel(package: Package, path: str) -> bool:
    """Tell whether a path is in a Bazel package, where xacro files are expanded."""
    directories = path.split("/")[:-1]
    return any(
        package.has("/".join((*directories[:depth], "BUILD.bazel")))
        for depth in range(1, len(directories) + 1)
    )
