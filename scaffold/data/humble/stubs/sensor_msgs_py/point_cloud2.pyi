from collections.abc import Iterable
from typing import Any
import numpy as np
from std_msgs.msg import Header as Header
from sensor_msgs.msg import PointCloud2 as PointCloud2, PointField as PointField
from numpy.lib.recfunctions import (
    structured_to_unstructured as structured_to_unstructured,
    unstructured_to_structured as unstructured_to_structured,
)

DUMMY_FIELD_PREFIX: str

def read_points(
    cloud: PointCloud2,
    field_names: list[str] | tuple[str, ...] | None = None,
    skip_nans: bool = False,
    uvs: Iterable[Any] | None = None,
    reshape_organized_cloud: bool = False,
) -> np.ndarray[Any, Any]: ...
def read_points_numpy(
    cloud: PointCloud2,
    field_names: list[str] | tuple[str, ...] | None = None,
    skip_nans: bool = False,
    uvs: Iterable[Any] | None = None,
    reshape_organized_cloud: bool = False,
) -> np.ndarray[Any, Any]: ...
def read_points_list(
    cloud: PointCloud2,
    field_names: list[str] | tuple[str, ...] | None = None,
    skip_nans: bool = False,
    uvs: Iterable[Any] | None = None,
) -> list[Any]: ...
def dtype_from_fields(
    fields: Iterable[PointField], point_step: int | None = None
) -> np.dtype[Any]: ...
def create_cloud(
    header: Header, fields: Iterable[PointField], points: Iterable[Any]
) -> PointCloud2: ...
def create_cloud_xyz32(header: Header, points: Iterable[Any]) -> PointCloud2: ...
