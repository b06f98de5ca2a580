"""The known commands of CMake and ament, and the targets of a CMakeLists.txt."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import takewhile
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from scaffold.api.cmake import Argument, CMakeLists, Command


_DEFINING = (
    "add_executable",
    "add_library",
    "add_custom_target",
    "ament_add_gtest",
    "ament_add_gmock",
    "ament_add_gtest_executable",
    "ament_auto_add_executable",
    "ament_auto_add_library",
    "ament_add_google_benchmark",
    "ament_auto_add_gtest",
    "rosidl_generate_interfaces",
    "generate_parameter_library",
    "pybind11_add_module",
    "qt5_add_executable",
)
TAKING_TARGETS = (
    "ament_target_dependencies",
    "target_link_libraries",
    "target_include_directories",
)
"""Commands whose first argument is an existing target."""


def defined_targets(cmake: CMakeLists) -> set[str] | None:
    """Return the defined targets; ``None`` if the name of one is unknown."""
    defined: set[str] = set()
    for command in cmake.commands:
        if command.name in _DEFINING and command.arguments:
            name = cmake.expand(command.arguments[0], command)
            if name is None:
                return None
            defined.add(name)
    return defined


def targets_named_once(cmake: CMakeLists) -> list[tuple[str, Argument]]:
    """Return the arguments with targets that are only used once."""
    used: list[tuple[str, Argument]] = []
    named: set[str] = set()
    for command in cmake.commands:
        taken: list[Argument] = []
        if command.name in TAKING_TARGETS:
            taken = command.arguments[:1]
        elif command.name == "install" and command.values[:1] == ["TARGETS"]:
            taken = _targets(command)
        named.update(_words(cmake, command, taken))
        if not command.blocks:
            used += [(cmake.expand(item, command) or "", item) for item in taken]
    return [
        (name, argument)
        for name, argument in used
        # Those of interfaces, such as my_msgs__rosidl_typesupport_cpp, are defined by one command.
        if name and name not in named and "__" not in name and not set("$:<;") & set(name)
    ]


def _targets(command: Command) -> list[Argument]:
    """Return the targets of ``install(TARGETS ...)``."""
    taken = takewhile(lambda item: not item.value.isupper(), command.arguments[1:])
    return list(taken)


def _words(cmake: CMakeLists, command: Command, taken: list[Argument]) -> Iterator[str]:
    """Yield the words of a command other than its targets, which may be parts of target names."""
    for argument in command.arguments:
        if argument not in taken:
            value = cmake.expand(argument, command) or argument.value
            yield value
            yield from value.split(";")


BUILT_IN = frozenset(
    """
    add_compile_definitions add_compile_options add_custom_command add_custom_target add_definitions
    add_dependencies add_executable add_library add_link_options add_subdirectory add_test
    aux_source_directory block break build_command build_name cmake_host_system_information
    cmake_language cmake_minimum_required cmake_parse_arguments cmake_path cmake_policy
    configure_file continue create_test_sourcelist ctest_build ctest_configure ctest_coverage
    ctest_empty_binary_directory ctest_memcheck ctest_read_custom_files ctest_run_script ctest_sleep
    ctest_start ctest_submit ctest_test ctest_update ctest_upload define_property else elseif
    enable_language enable_testing endblock endforeach endfunction endif endmacro endwhile
    exec_program execute_process export export_library_dependencies file find_file find_library
    find_package find_path find_program fltk_wrap_ui foreach function get_cmake_property
    get_directory_property get_filename_component get_property get_source_file_property
    get_target_property get_test_property if include include_directories include_external_msproject
    include_guard include_regular_expression install install_files install_programs install_targets
    link_directories link_libraries list load_cache load_command macro make_directory
    mark_as_advanced math message option output_required_files project qt_wrap_cpp qt_wrap_ui remove
    remove_definitions return separate_arguments set set_directory_properties set_property
    set_source_files_properties set_target_properties set_tests_properties site_name source_group
    string subdir_depends subdirs target_compile_definitions target_compile_features
    target_compile_options target_include_directories target_link_directories target_link_libraries
    target_link_options target_precompile_headers target_sources try_compile try_run unset
    use_mangled_mesa utility_source variable_requires variable_watch while write_file
    """.split()  # noqa: SIM905  a column of quoted names would hide them
)
"""The commands of CMake itself, in lower case."""
OF_AMENT = frozenset(
    """
    ament_add_gmock ament_add_gtest ament_add_gtest_executable ament_add_gtest_test
    ament_add_pytest_test ament_add_test ament_copyright
    ament_environment_hooks ament_export_dependencies ament_export_include_directories
    ament_export_libraries ament_export_targets ament_flake8 ament_index_register_resource
    ament_lint_auto_find_test_dependencies ament_package ament_pep257 ament_python_install_module
    ament_python_install_package ament_target_dependencies ament_uncrustify ament_xmllint
    ament_auto_package ament_auto_add_executable ament_auto_add_library
    ament_auto_find_build_dependencies rosidl_generate_interfaces rosidl_get_typesupport_target
    rclcpp_components_register_node rclcpp_components_register_nodes add_launch_test
    add_ros_test pluginlib_export_plugin_description_file
    """.split()  # noqa: SIM905  a column of quoted names would hide them
)
"""The commands of ament and of packages used with it."""
