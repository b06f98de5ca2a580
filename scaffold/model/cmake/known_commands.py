"""The commands of CMake, ament and the distribution."""

from __future__ import annotations

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

_PREFIXES = (
    *("ament_", "catkin_", "generate_parameter_", "pluginlib_", "pybind11_", "rclcpp_", "rosidl_"),
    *("add_rostest", "gtest_", "gz_find_", "ign_find_", "qt5_", "qt6_", "qt_", "roslint_"),
    *("check_", "cmake_", "configure_package_", "fetchcontent_", "generate_export_", "pkg_"),
    "write_basic_package_",
)
"""The first parts of names of commands that install nothing but what they are given or build."""
_OTHERS = frozenset(
    """
    add_action_files add_message_files add_service_files export_windows_symbols externalproject_add
    find_ros1_interface_packages find_ros1_package generate_dynamic_reconfigure_options
    generate_messages get_default_rmw_implementation get_rmw_typesupport moveit_package nav2_package
    register_rmw_implementation roslaunch_add_file_check set_compiler_options
    """.split()  # noqa: SIM905  a column of quoted names would hide them
)
"""Further commands of the distribution and of ROS 1."""
MODULES = frozenset(
    """
    checkcsourcecompiles checkcxxcompilerflag checkcxxsourcecompiles checkincludefiles
    checksymbolexists checktypesize cmakedependentoption cmakepackageconfighelpers
    cmakeprinthelpers cpack ctest generateexportheader gnuinstalldirs googletest testbigendian
    """.split()  # noqa: SIM905  a column of quoted names would hide them
)
"""Modules of CMake that only define commands or variables, in lower case."""


def is_known(name: str) -> bool:
    """Return whether the effects of a command are known; others may install any file."""
    return name in BUILT_IN or name in OF_AMENT or name in _OTHERS or name.startswith(_PREFIXES)
