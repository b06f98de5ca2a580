from typing import Any, TypeVar

import numpy as np

from geometry_msgs.msg import Transform as Transform, TransformStamped as TransformStamped
from sensor_msgs.msg import PointCloud2 as PointCloud2

_T = TypeVar("_T")

def to_msg_msg(msg: _T) -> _T: ...
def from_msg_msg(msg: _T) -> _T: ...
def transform_points(
    point_cloud: np.ndarray[Any, Any], transform: Transform
) -> np.ndarray[Any, Any]: ...
def do_transform_cloud(
    cloud: PointCloud2, transform: Transform | TransformStamped
) -> PointCloud2: ...
