from typing import Any, TypeVar

import numpy as np
import tf2_ros as tf2_ros

from geometry_msgs.msg import (
    Point as Point,
    Point32 as Point32,
    PointStamped as PointStamped,
    PolygonStamped as PolygonStamped,
    Pose as Pose,
    PoseStamped as PoseStamped,
    PoseWithCovarianceStamped as PoseWithCovarianceStamped,
    TransformStamped as TransformStamped,
    Vector3Stamped as Vector3Stamped,
)

_T = TypeVar("_T")

def to_msg_msg(msg: _T) -> _T: ...
def from_msg_msg(msg: _T) -> _T: ...
def transform_covariance(cov_in: Any, transform: Any) -> np.ndarray[Any, Any]: ...
def do_transform_point(point: PointStamped, transform: TransformStamped) -> PointStamped: ...
def do_transform_vector3(
    vector3: Vector3Stamped, transform: TransformStamped
) -> Vector3Stamped: ...
def do_transform_pose(pose: Pose, transform: TransformStamped) -> Pose: ...
def do_transform_pose_stamped(pose: PoseStamped, transform: TransformStamped) -> PoseStamped: ...
def do_transform_pose_with_covariance_stamped(
    pose: PoseWithCovarianceStamped, transform: TransformStamped
) -> PoseWithCovarianceStamped: ...
def do_transform_polygon_stamped(
    polygon: PolygonStamped, transform: TransformStamped
) -> PolygonStamped: ...
