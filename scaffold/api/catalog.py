"""Known ROS names: packages, rosdep keys, and their transitive dependencies."""

from __future__ import annotations

from scaffold.model.catalog import (
    BUILD_TOOLS,
    LIBRARY_KEYS,
    OTHER_NAMES,
    ROS1_PACKAGES,
    ROS_PACKAGES,
    is_near,
    keys_of_module,
    module_keys,
    module_of_key,
    similar_key,
    similar_package,
)
from scaffold.model.released import dependencies as released_dependencies
from scaffold.model.released import (
    has_rosdep_rule,
    is_released,
    is_rosdep_key,
    transitive_dependencies,
)

__all__ = [
    "BUILD_TOOLS",
    "LIBRARY_KEYS",
    "OTHER_NAMES",
    "ROS1_PACKAGES",
    "ROS_PACKAGES",
    "has_rosdep_rule",
    "is_near",
    "is_released",
    "is_rosdep_key",
    "keys_of_module",
    "module_keys",
    "module_of_key",
    "released_dependencies",
    "similar_key",
    "similar_package",
    "transitive_dependencies",
]
