# The targets that the ROS wheels export name directories of Python on the machine that built them.
# CMake refuses directories that are not there, so these go once all packages have been found.

function(_ros2_scaffold_drop_missing_includes)
  get_property(targets DIRECTORY PROPERTY IMPORTED_TARGETS)
  foreach(target IN LISTS targets)
    get_property(directories TARGET "${target}" PROPERTY INTERFACE_INCLUDE_DIRECTORIES)
    set(kept)
    foreach(directory IN LISTS directories)
      if(NOT directory MATCHES "^/opt/python/" OR EXISTS "${directory}")
        list(APPEND kept "${directory}")
      endif()
    endforeach()
    if(NOT "${kept}" STREQUAL "${directories}")
      set_property(TARGET "${target}" PROPERTY INTERFACE_INCLUDE_DIRECTORIES "${kept}")
    endif()
  endforeach()
endfunction()

if(CMAKE_VERSION VERSION_GREATER_EQUAL 3.21)
  cmake_language(
    DEFER DIRECTORY "${CMAKE_SOURCE_DIR}" CALL _ros2_scaffold_drop_missing_includes)
endif()
