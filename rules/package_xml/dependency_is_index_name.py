"""PX023: Python libraries are declared by their rosdep key."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Edit, Example, Fix, Package, Report, Rule, ViewError
from scaffold.api.catalog import keys_of_module, module_of_key


class DependencyIsIndexName(Rule):
    """A dependency is named as on PyPI instead of by its rosdep key.

    **Why.** rosdep has no key ``numpy``: ``rosdep install`` and the release stop.

    **Fix.** Write the rosdep key, usually ``python3-`` and the name.

    **Source.** ROS 2 documentation, "Using Python packages with ROS 2".
    """

    code = "PX023"
    name = "dependency-is-index-name"
    examples = (
        Example(
            "the rosdep key",
            {"package.xml": "<package><exec_depend>python3-numpy</exec_depend></package>\n"},
        ),
        Example(
            "a library in C++ of the same name",
            {
                "package.xml": "<package>\n  <depend>serial</depend>\n</package>\n",
                "CMakeLists.txt": "project(talker)\nfind_package(serial REQUIRED)\n",
            },
        ),
        Example(
            "what only the documentation needs, which rosdep does not install",
            {"package.xml": "<package>\n  <doc_depend>numpy</doc_depend>\n</package>\n"},
        ),
        Example(
            "the name for pip",
            {"package.xml": "<package>\n  <exec_depend>numpy</exec_depend>\n</package>\n"},
            Report(
                "2:16",
                "rosdep has no key 'numpy'; its key is 'python3-numpy'",
                fix="write python3-numpy",
            ),
            fixed={
                "package.xml": "<package>\n  <exec_depend>python3-numpy</exec_depend>\n</package>\n"
            },
        ),
        Example(
            "OpenCV, for C++",
            {
                "package.xml": "<package>\n  <depend>opencv</depend>\n</package>\n",
                "CMakeLists.txt": "project(talker)\nfind_package(OpenCV REQUIRED)\n",
            },
            Report(
                "package.xml:2:11",
                "rosdep has no key 'opencv'; its key is 'libopencv-dev'",
                fix="write libopencv-dev",
            ),
            fixed={"package.xml": "<package>\n  <depend>libopencv-dev</depend>\n</package>\n"},
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for dependency in package.manifest.dependencies:
            module = module_of_key(dependency.name)
            if module is None or package.workspace.get(dependency.name) is not None:
                continue
            if dependency.kind == "doc_depend" or not dependency.may_be_active:
                continue  # which rosdep does not install
            if _is_found_by_cmake(package, dependency.name):
                continue
            key = _key(package, module)
            message = f"rosdep has no key {dependency.name!r}; its key is {key!r}"
            edit = Edit("package.xml", *dependency.element.text_span, key)
            fix = Fix(f"write {key}", (edit,))
            yield self.report(dependency, message, fix, cause=f"dependency {key}")


def _is_found_by_cmake(package: Package, name: str) -> bool:
    """Tell whether a name is that of a C++ library: serial is one, too."""
    try:
        return bool(package.cmake.finds(name))
    except ViewError:
        return False


def _key(package: Package, module: str) -> str:
    """Return the key of a library; code in C++ needs that of OpenCV for C++."""
    keys = keys_of_module(module)
    try:
        is_compiled = module == "cv2" and package.cmake.finds("OpenCV")
    except ViewError:
        is_compiled = False
    return "libopencv-dev" if is_compiled else keys[0]
