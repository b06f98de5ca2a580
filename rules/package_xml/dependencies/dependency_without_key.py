"""PX081: a dependency is exactly one rosdep key or package."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Edit, Effect, Example, Fix, Package, Report, Rule, ViewError
from scaffold.api.catalog import (
    keys_of_module,
    module_of_key,
)
from scaffold.api.manifest import is_fetched

from ._names_without_key import is_found_by_cmake, is_of_cpp, why_no_key

_PYTHON = "  <export><build_type>ament_python</build_type></export>\n</package>"
_MANIFEST = (
    '<package format="3">\n  <name>talker</name>\n  <exec_depend>{}</exec_depend>\n</package>\n'
)


class DependencyWithoutKey(Rule):
    """The text of a dependency is empty, or neither a rosdep key nor the name of a package.

    **Why.** ``rosdep install`` stops: ``Cannot locate rosdep definition for [std_msgs.msg]``, and
    colcon does not build packages in the right order. bloom stops at an empty one.

    **Fix.** Write one package name in each element; versions are attributes such as
    ``version_gte``. The rosdep key of a Python library is usually ``python3-`` and its name.
    ``ament_python`` is a build type, not a package.

    **Source.** REP 149, dependencies; REP 111; ROS 2 documentation, "Using Python packages with
    ROS 2".
    """

    code = "PX081"
    name = "dependency-without-key"
    effect = Effect.STOPS_ROSDEP
    examples = (
        Example("a package", {"package.xml": _MANIFEST.format("std_msgs")}),
        Example(
            "a C++ package with the name of a Python module that another package has",
            {"package.xml": _MANIFEST.format("tf2_ros")},
        ),
        Example(
            "for ROS 1",
            {
                "package.xml": _MANIFEST.format("python-numpy").replace(
                    "<exec_depend", "<exec_depend condition='$ROS_PYTHON_VERSION == 2'"
                )
            },
        ),
        Example(
            "a module",
            {"package.xml": _MANIFEST.format("std_msgs.msg")},
            "3:16: 'std_msgs.msg' is a module: rosdep stops; the package is 'std_msgs'",
        ),
        Example(
            "a version",
            {"package.xml": _MANIFEST.format("numpy&gt;=1.2")},
            "3:16: 'numpy>=1.2' contains a version, which rosdep treats as part of the name; use "
            "version_gte='...'",
        ),
        Example(
            "a stray character",
            {"package.xml": _MANIFEST.format("rclpy&gt;")},
            "3:16: 'rclpy>' contains '>': rosdep stops; remove it",
        ),
        Example(
            "a Debian package",
            {"package.xml": _MANIFEST.format("ros-jazzy-std-msgs")},
            "3:16: 'ros-jazzy-std-msgs' is a Debian package; its rosdep key is 'std_msgs'",
        ),
        Example(
            "a build type",
            {"package.xml": _MANIFEST.format("ament_python")},
            "3:16: 'ament_python' is a build type, not a package: rosdep cannot resolve it; "
            "remove it",
        ),
        Example(
            "empty",
            {"package.xml": "<package>\n  <depend></depend>\n</package>\n"},
            Report("2:3", "<depend> is empty: bloom stops; remove it", fix="Remove the dependency"),
            fixed={"package.xml": "<package>\n</package>\n"},
        ),
        Example(
            "two names, underscores, Python 2",
            {
                "package.xml": _MANIFEST.format(
                    "rclpy std_msgs</exec_depend>\n"
                    "  <exec_depend>python3_numpy</exec_depend>\n"
                    "  <exec_depend>python-numpy"
                )
            },
            "3:16: 'rclpy std_msgs' contains several names: rosdep stops; write an element for "
            "each",
            "4:16: rosdep keys contain dashes, not underscores; use 'python3-numpy'",
            "5:16: 'python-numpy' is a Python 2 package: rosdep stops; use 'python3-numpy'",
        ),
        Example(
            "keys of Python 2, and keys for pip",
            {
                "package.xml": _MANIFEST.format(
                    "python-flask</exec_depend>\n"
                    "  <exec_depend>python-rpi.gpio</exec_depend>\n"
                    "  <exec_depend>python-docx</exec_depend>\n"
                    "  <exec_depend>python-pymap3d-pip"
                )
            },
            "3:16: 'python-flask' is a Python 2 package: rosdep stops; use 'python3-flask'",
            "4:16: 'python-rpi.gpio' is a Python 2 package: rosdep stops; use the key for Python 3",
        ),
        Example(
            "a module of Python itself, and a key with the name of one",
            {"package.xml": _MANIFEST.format("threading</exec_depend>\n  <exec_depend>time")},
            "3:16: 'threading' is a module of Python itself: rosdep stops; remove it",
        ),
        Example(
            "a C++ library with the name of a module",
            {
                "package.xml": _MANIFEST.format("argparse"),
                "CMakeLists.txt": "project(talker)\nfind_package(argparse REQUIRED)\n",
            },
        ),
        Example(
            "a Python package in the package",
            {
                "package.xml": _MANIFEST.format("helpers").replace("</package>", _PYTHON),
                "setup.py": "from setuptools import setup\n\n"
                "setup(name='talker', packages=['talker', 'helpers'])\n",
                "helpers/__init__.py": "",
            },
            "package.xml:3:16: 'helpers' is a Python package in this package: rosdep stops; "
            "remove it",
        ),
        Example(
            "a package that CMake knows under another name",
            {"package.xml": _MANIFEST.format("Eigen3")},
            "3:16: 'Eigen3' is not a rosdep key: rosdep stops; the key is 'eigen'",
        ),
        Example(
            "the rosdep key",
            {"package.xml": "<package><exec_depend>python3-numpy</exec_depend></package>\n"},
        ),
        Example(
            "a C++ library with the same name",
            {
                "package.xml": "<package>\n  <depend>serial</depend>\n</package>\n",
                "CMakeLists.txt": "project(talker)\nfind_package(serial REQUIRED)\n",
            },
        ),
        Example(
            "a documentation dependency, which rosdep does not install",
            {"package.xml": "<package>\n  <doc_depend>numpy</doc_depend>\n</package>\n"},
        ),
        Example(
            "the name for pip",
            {"package.xml": "<package>\n  <exec_depend>numpy</exec_depend>\n</package>\n"},
            Report(
                "2:16",
                "'numpy' is not a rosdep key: rosdep stops; the key is 'python3-numpy'",
                fix="Replace with python3-numpy",
            ),
            fixed={
                "package.xml": "<package>\n  <exec_depend>python3-numpy</exec_depend>\n</package>\n"
            },
        ),
        Example(
            "the name of a Python library, in a C++ package",
            {
                "package.xml": "<package>\n  <depend>serial</depend>\n</package>\n",
                "CMakeLists.txt": "project(talker)\nfind_package(libserial REQUIRED)\n",
            },
            "package.xml:2:11: 'serial' is not a rosdep key: rosdep stops; the key of the Python "
            "library is 'python3-serial'",
        ),
        Example(
            "OpenCV, for C++ that finds its dependencies automatically",
            {
                "package.xml": "<package>\n  <depend>OpenCV</depend>\n</package>\n",
                "CMakeLists.txt": "project(talker)\nfind_package(ament_cmake_auto REQUIRED)\n"
                "ament_auto_find_build_dependencies()\n",
            },
            Report(
                "package.xml:2:11",
                "'OpenCV' is not a rosdep key: rosdep stops; the key is 'libopencv-dev'",
                fix="Replace with libopencv-dev",
            ),
            fixed={"package.xml": "<package>\n  <depend>libopencv-dev</depend>\n</package>\n"},
        ),
        Example(
            "OpenCV under the name of CMake",
            {
                "package.xml": "<package>\n  <depend>OpenCV</depend>\n</package>\n",
                "CMakeLists.txt": "project(talker)\nfind_package(OpenCV REQUIRED)\n",
            },
            "package.xml:2:11: 'OpenCV' is not a rosdep key: rosdep stops; the key is "
            "'libopencv-dev'",
        ),
        Example(
            "OpenCV, for C++",
            {
                "package.xml": "<package>\n  <depend>opencv</depend>\n</package>\n",
                "CMakeLists.txt": "project(talker)\nfind_package(OpenCV REQUIRED)\n",
            },
            Report(
                "package.xml:2:11",
                "'opencv' is not a rosdep key: rosdep stops; the key is 'libopencv-dev'",
                fix="Replace with libopencv-dev",
            ),
            fixed={"package.xml": "<package>\n  <depend>libopencv-dev</depend>\n</package>\n"},
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        yield from self._check_index_names(package)
        manifest = package.manifest
        for dependency in manifest.dependencies:
            if not dependency.name and not dependency.element.children:
                fix = Fix("Remove the dependency", (manifest.remove(dependency.element),))
                message = f"<{dependency.kind}> is empty: bloom stops; remove it"
                yield self.report(dependency.element, message, fix)
                continue
            problem = ""
            if dependency.active and not _is_source(package, dependency.name):
                problem = why_no_key(package, dependency.name)
            if problem and dependency.kind != "doc_depend":
                yield self.report(dependency, problem, cause=f"dependency {dependency.name}")

    def _check_index_names(self, package: Package) -> Iterator[Diagnostic]:
        for dependency in package.manifest.dependencies:
            module = module_of_key(dependency.name)
            if module is None or package.workspace.get(dependency.name) is not None:
                continue
            if dependency.kind == "doc_depend" or not dependency.may_be_active:
                continue  # which rosdep does not install
            if is_found_by_cmake(package, dependency.name):
                continue
            key = _key(package, module)
            message = f"{dependency.name!r} is not a rosdep key: rosdep stops; the key"
            edit = Edit("package.xml", *dependency.element.text_span, key)
            fix: Fix | None = Fix(f"Replace with {key}", (edit,))
            if key.startswith("python3-") and is_of_cpp(package, module):
                message, fix = f"{message} of the Python library", None
            yield self.report(dependency, f"{message} is {key!r}", fix, cause=f"dependency {key}")


def _is_source(package: Package, name: str) -> bool:
    """Return whether a package is in the workspace, or fetched into it."""
    return package.workspace.get(name) is not None or is_fetched(package, name)


def _key(package: Package, module: str) -> str:
    """Return the key of a library; C++ code needs the key of OpenCV for C++."""
    keys = keys_of_module(module)
    try:
        is_found = package.cmake.finds_automatically or package.cmake.finds("OpenCV")
    except ViewError:
        is_found = False
    return "libopencv-dev" if is_found and module == "cv2" else keys[0]
