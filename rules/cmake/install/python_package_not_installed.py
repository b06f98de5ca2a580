"""CM017: modules that nodes import are installed."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Edit, Example, Fix, Package, Report, Rule
from scaffold.api.cmake import has_unknown_commands

_LISTS = "project(talker)\nfind_package(ament_cmake_python REQUIRED)\n{}ament_package()\n"
_CALL = "ament_python_install_package(${PROJECT_NAME})\n"
_FILES = {
    "talker/__init__.py": "",
    "talker/node.py": "from talker.text import hello\n",
    "talker/text.py": "",
}
INSTALLERS = (
    "ament_python_install_package",
    "ament_python_install_module",
    "ament_auto_package",
    "rosidl_generate_interfaces",
    "generate_parameter_module",
    "_ament_cmake_python_install_package",
)


class PythonPackageNotInstalled(Rule):
    """A Python package that code imports is not installed.

    **Why.** The build succeeds, but the node fails with ``ModuleNotFoundError: No module named
    'talker'``.

    **Fix.** Call ``ament_python_install_package(${PROJECT_NAME})``.

    **Source.** ROS 2 documentation, "ament_cmake_python user documentation".
    """

    code = "CM017"
    name = "python-package-not-installed"
    examples = (
        Example("installed", {**_FILES, "CMakeLists.txt": _LISTS.format(_CALL)}),
        Example(
            "not installed",
            {**_FILES, "CMakeLists.txt": _LISTS.format("")},
            Report(
                "CMakeLists.txt:3:1",
                "talker/ is not installed, but talker/node.py:1 imports it: "
                "ModuleNotFoundError; call "
                "ament_python_install_package(${PROJECT_NAME})",
                fix="Install the Python package",
            ),
            fixed={"CMakeLists.txt": _LISTS.format(f"{_CALL}\n")},
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        cmake = package.cmake
        name = cmake.project_name
        calls = [call for call in cmake.find("ament_package") if not call.blocks]
        if not name or not calls or cmake.find(*INSTALLERS) or has_unknown_commands(package):
            return
        if not package.has(f"{name}/__init__.py") or self._is_installed(package, name):
            return
        user = next(
            (
                item.location
                for module in package.modules()
                for item in module.imports
                if item.root == name and not module.in_tests
            ),
            None,
        )
        if user is None:
            return
        start = calls[0].start
        text = _CALL + "\n"
        fix = None
        if cmake.finds("ament_cmake_python"):
            fix = Fix("Install the Python package", (Edit(calls[0].path, start, start, text),))
        message = (
            f"{name}/ is not installed, but {user.path}:{user.line} imports it: "
            f"ModuleNotFoundError; call ament_python_install_package(${{PROJECT_NAME}})"
        )
        yield self.report(calls[0].name_location, message, fix)

    def _is_installed(self, package: Package, name: str) -> bool:
        return any(
            item.path is None or item.path in {name, "."}
            for install in package.cmake.installs
            if install.kind == "DIRECTORY" and "python" in (install.destination or "python")
            for item in install.items
        )
