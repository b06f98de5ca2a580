"""CMakeLists.txt: its commands, and what they install, find and generate."""

from __future__ import annotations

from scaffold.model.cmake.known_commands import BUILT_IN, OF_AMENT
from scaffold.model.cmake.lists import CMakeLists, FoundPackage, Install, InstallItem
from scaffold.model.cmake.parser import Argument, Command
from scaffold.model.cmake.rosidl import Generation
from scaffold.model.contents.ament_cmake import (
    PACKAGE_COMMANDS,
    Program,
    has_unknown_commands,
    installs_directory,
    is_built_for_ros1,
    is_made_by_build,
    is_used_by_build,
    nested,
    programs,
    runs_with_python,
    subdirectories,
    uses_ament,
)
from scaffold.model.contents.interface_files import (
    generations,
    is_interface_package,
    may_generate_more,
)

__all__ = [
    "BUILT_IN",
    "OF_AMENT",
    "PACKAGE_COMMANDS",
    "Argument",
    "CMakeLists",
    "Command",
    "FoundPackage",
    "Generation",
    "Install",
    "InstallItem",
    "Program",
    "generations",
    "has_unknown_commands",
    "installs_directory",
    "is_built_for_ros1",
    "is_interface_package",
    "is_made_by_build",
    "is_used_by_build",
    "may_generate_more",
    "nested",
    "programs",
    "runs_with_python",
    "subdirectories",
    "uses_ament",
]
