"""URDF and xacro files, and ros_gz_bridge configurations."""

from __future__ import annotations

from scaffold.model.robot.expressions import UNKNOWN_MARK, is_known, may_be, shown
from scaffold.model.robot.files import RobotFile, robot_file, robot_paths
from scaffold.model.robot.robots import (
    Robots,
    is_argument_given,
    is_launched,
    named_files,
    robots,
    urdf_parts,
)
from scaffold.model.robot.xacro.expansion import Expansion
from scaffold.model.robot.xacro.parts import NamedFile, Part
from scaffold.model.robot.xacro.problems import Misfit, Problems, Undefined

__all__ = [
    "UNKNOWN_MARK",
    "Expansion",
    "Misfit",
    "NamedFile",
    "Part",
    "Problems",
    "RobotFile",
    "Robots",
    "Undefined",
    "is_argument_given",
    "is_known",
    "is_launched",
    "may_be",
    "named_files",
    "robot_file",
    "robot_paths",
    "robots",
    "shown",
    "urdf_parts",
]
