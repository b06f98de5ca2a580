"""The controllers that ros2_controllers has, and those of ROS 1 that it does not have."""

from __future__ import annotations

from collections.abc import Mapping

from scaffold.api import Package, closest_name

_TRAJECTORY = "joint_trajectory_controller/JointTrajectoryController"
_OF_ROS1: Mapping[str, str] = {
    "joint_state_controller/JointStateController": "joint_state_broadcaster/JointStateBroadcaster",
    **{
        f"{kind}_controllers/JointTrajectoryController": _TRAJECTORY
        for kind in ("position", "velocity", "effort")
    },
    "position_controllers/JointPositionController": (
        "position_controllers/JointGroupPositionController"
    ),
    "velocity_controllers/JointVelocityController": (
        "velocity_controllers/JointGroupVelocityController"
    ),
    "effort_controllers/JointEffortController": "effort_controllers/JointGroupEffortController",
    "effort_controllers/JointPositionController": "pid_controller/PidController",
    "effort_controllers/JointVelocityController": "pid_controller/PidController",
}
"""Controller types that ROS 2 does not have, with their replacements."""
_OF_ROS2: Mapping[str, tuple[str, ...]] = {
    "ackermann_steering_controller": ("AckermannSteeringController",),
    "admittance_controller": ("AdmittanceController",),
    "bicycle_steering_controller": ("BicycleSteeringController",),
    "diff_drive_controller": ("DiffDriveController",),
    "effort_controllers": ("GripperActionController", "JointGroupEffortController"),
    "force_torque_sensor_broadcaster": ("ForceTorqueSensorBroadcaster",),
    "forward_command_controller": (
        "ForwardCommandController",
        "MultiInterfaceForwardCommandController",
    ),
    "imu_sensor_broadcaster": ("IMUSensorBroadcaster",),
    "joint_state_broadcaster": ("JointStateBroadcaster",),
    "joint_trajectory_controller": ("JointTrajectoryController",),
    "mecanum_drive_controller": ("MecanumDriveController",),
    "pid_controller": ("PidController",),
    "pose_broadcaster": ("PoseBroadcaster",),
    "range_sensor_broadcaster": ("RangeSensorBroadcaster",),
    "tricycle_controller": ("TricycleController",),
    "tricycle_steering_controller": ("TricycleSteeringController",),
    "velocity_controllers": ("JointGroupVelocityController",),
}
"""The controllers of ros2_controllers, by package."""


def replacement(package: Package, type_: str) -> str:
    """Return the controller to use instead of one that does not exist; empty if unknown."""
    if type_ in _OF_ROS1:
        return _OF_ROS1[type_]
    name, _, controller = type_.partition("/")
    known = _OF_ROS2.get(name, ())
    if controller in known or package.workspace.get(name) is not None:
        return ""
    closest = closest_name(package, controller, known, 0.7)
    return f"{name}/{closest}" if closest else ""
