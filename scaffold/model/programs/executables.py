"""The executables that ``ros2 run`` finds, and their nodes."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from scaffold.model.catalog import keys_of_module
from scaffold.model.contents.ament_cmake import programs, subdirectories
from scaffold.model.contents.python_facts import imports_of
from scaffold.model.install.configured_scripts import (
    configured_scripts,
    installs_configured,
    installs_unknown_scripts,
    unknown_groups,
)
from scaffold.model.programs.known_nodes import KnownNode, known_nodes
from scaffold.model.remembered import remembered, remembered_list
from scaffold.record import NamedTuple
from scaffold.source import ViewError

if TYPE_CHECKING:
    from scaffold.model.cmake.lists import CMakeLists
    from scaffold.model.package import Package

_PLAIN_COMMANDS = frozenset(
    """
    add_compile_definitions add_compile_options add_definitions add_dependencies add_executable
    add_launch_test add_library add_test ament_add_gmock ament_add_gtest ament_add_pytest_test
    ament_add_test ament_auto_add_executable ament_auto_add_library
    ament_auto_find_build_dependencies ament_auto_package ament_clang_format ament_clang_tidy
    ament_copyright ament_cppcheck ament_cpplint ament_environment_hooks
    ament_export_dependencies ament_export_include_directories ament_export_interfaces
    ament_export_libraries ament_export_targets ament_flake8 ament_index_register_resource
    ament_lint_auto_find_test_dependencies ament_lint_cmake ament_mypy ament_package
    ament_pep257 ament_python_install_module ament_python_install_package
    ament_target_dependencies ament_uncrustify ament_xmllint cmake_minimum_required
    cmake_parse_arguments cmake_policy else elseif enable_language enable_testing endforeach
    endfunction endif endmacro file find_library find_package find_path find_program foreach
    function get_filename_component if include_directories install link_directories
    link_libraries list macro math message moveit_package option pkg_check_modules
    pkg_search_module pluginlib_export_plugin_description_file project
    rclcpp_components_register_node rclcpp_components_register_nodes return
    rosidl_generate_interfaces rosidl_get_typesupport_target rosidl_target_interfaces set
    set_property set_target_properties set_tests_properties string target_compile_definitions
    target_compile_features target_compile_options target_include_directories
    target_link_directories target_link_libraries target_precompile_headers unset
    """.split()  # noqa: SIM905  a column of quoted names would hide them
)
"""Commands that define no programs, or ones with literal names."""


class Programs(NamedTuple):
    """The programs of a package."""

    sources: dict[str, str]
    """The Python file of each program by name; empty for other languages."""
    complete: bool
    """Whether these are all."""


@remembered
def programs_of(package: Package) -> Programs:
    """Return the programs that a package installs in ``lib/<package>``."""
    read = {"ament_cmake": _by_cmake, "ament_python": _by_setup}.get(package.build_type)
    try:
        return read(package) if read else Programs({}, complete=False)
    except ViewError:
        return Programs({}, complete=False)


def nodes_of(package: Package, program: str) -> Sequence[KnownNode]:
    """Return the possible nodes of a Python program; only one if certain."""
    key = ("nodes_of_program", program)
    return package.remember(key, lambda: _find_nodes_of(package, program))


def _find_nodes_of(package: Package, program: str) -> Sequence[KnownNode]:
    path = programs_of(package).sources.get(program)
    if not path:
        return []
    try:
        result = [*known_nodes(package, path)]
    except ViewError:
        return []
    for name in _imported(package, path):
        result.extend(known_nodes(package, name))
    result.extend(_made_by_others(package, path))
    return result


def _made_by_others(package: Package, path: str) -> Iterator[KnownNode]:
    """Yield the nodes created by imported functions of other packages."""
    for item in imports_of(package, path):
        if item.level or item.root == package.name or keys_of_module(item.root):
            continue
        other = package.workspace.get(item.root)
        stem = item.module.replace(".", "/")
        for name in (f"{stem}.py", f"src/{stem}.py"):
            if other is None or not other.has(name):
                continue
            with contextlib.suppress(ViewError):
                yield from (node for node in known_nodes(other, name) if not node.is_class)


@remembered_list
def _imported(package: Package, path: str) -> Iterator[str]:
    """Return the files of the package that a file imports from."""
    roots = ("", "src/", f"{path.rpartition('/')[0]}/")
    for item in imports_of(package, path):
        if item.level or item.in_function:
            base = path.rpartition("/")[0] if item.level == 1 else ""
            stem = "/".join(part for part in (base, *item.module.split(".")) if part)
            names = [stem] if base else []
        else:
            names = [root + item.module.replace(".", "/") for root in dict.fromkeys(roots)]
        for stem in names:
            modules = (stem, *(f"{stem}/{imported.name}" for imported in item.names))
            files = [file for file in (f"{name}.py" for name in modules) if package.has(file)]
            readable = [file for file in files if file != path and _is_readable(package, file)]
            yield from readable
            if readable:
                break


def _is_readable(package: Package, path: str) -> bool:
    """Return whether a file can be parsed."""
    try:
        known_nodes(package, path)
    except ViewError:
        return False
    return True


def _by_setup(package: Package) -> Programs:
    setup = package.setup_py
    if setup.call is None:
        return Programs({}, complete=False)
    complete = setup.entry_points_complete and not setup.has_unknown_keywords
    complete = complete and setup.data_files_complete and setup.keyword("scripts") is None
    sources: dict[str, str] = {}
    for entry in setup.entry_points:
        if entry.group in {"console_scripts", "gui_scripts"}:
            complete = complete and entry.malformed is None
            sources[entry.name] = _file_of(package, entry.module)
    for data in setup.data_files:
        if str(data.destination).startswith("lib"):
            complete = False
    sources.update(_configured(package))
    return Programs(sources, complete and not unknown_groups(package))


def _configured(package: Package) -> dict[str, str]:
    """Return the programs that setup.cfg declares."""
    if not installs_configured(package):
        return {}
    return {script.name: _file_of(package, script.module) for script in configured_scripts(package)}


def _file_of(package: Package, module: str) -> str:
    """Return the file of a module; empty if there is none."""
    base = module.replace(".", "/")
    paths = [f"{base}.py", f"{base}/__init__.py", f"src/{base}.py"]
    return next(filter(package.has, paths), "")


def _is_plain(lists: CMakeLists) -> bool:
    """Return whether no command of a file may install executables in another way."""
    plain = _PLAIN_COMMANDS | lists.defined | {"add_subdirectory"}
    return all(command.name in plain or command in lists.followed for command in lists.commands)


def _by_cmake(package: Package) -> Programs:
    cmake = package.cmake
    below = subdirectories(package)
    files = (cmake, *(below or ()))
    complete = below is not None and all(map(_is_plain, files))
    complete = complete and (installs_configured(package) or not installs_unknown_scripts(package))
    sources = _configured(package)
    for program in programs(package):
        destination = (program.destination or "").rstrip("/")
        if destination == f"lib/{package.name}":
            is_python = program.path in package.python_files
            sources[program.name] = program.path if is_python else ""
    for install in (install for lists in files for install in lists.installs):
        if install.kind == "TARGETS":
            complete = complete and all(item.value is not None for item in install.items)
            sources.update({item.value: "" for item in install.items if item.value})
        elif any(item.path is None for item in install.items):
            complete = False
        elif install.destination is None or install.kind == "DIRECTORY":
            lib = install.destination is None or install.destination.startswith("lib")
            complete = complete and not lib
    for names in (names for lists in files for names in _made_by_commands(lists)):
        complete = complete and names is not None
        sources.update(dict.fromkeys(names or (), ""))
    renames = any("OUTPUT_NAME" in command.values for lists in files for command in lists.commands)
    return Programs(sources, complete and not renames)


def _made_by_commands(cmake: CMakeLists) -> Iterator[list[str] | None]:
    """Yield the executables of commands that also install them; ``None`` for unknown ones."""
    for command in cmake.find("rclcpp_components_register_node", "ament_auto_add_executable"):
        written = command.arguments[:1]
        if command.name == "rclcpp_components_register_node":
            written = command.keyword("EXECUTABLE", {"PLUGIN", "EXECUTOR"})
        for turn in cmake.turns(command):
            yield cmake.expand_list(written, command, turn)
