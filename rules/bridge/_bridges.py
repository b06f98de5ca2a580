"""Configurations of ros_gz_bridge: the topics of ROS and Gazebo that it connects.

Derived from ros_gz 1.0 (Jazzy): ``bridge_config.cpp`` and ``mappings.py``.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, NamedTuple

from scaffold.api import Location, ParseError, ViewError
from scaffold.api.formats import Mapping, Scalar, Sequence, yaml_tree

if TYPE_CHECKING:
    from scaffold.api import Package

_MARKS = (
    *("gz_type_name", "ros_type_name", "ign_type_name", "gz_topic_name"),
    *("gz.msgs.", "direction:"),
)
_FEW = 2
_MAPPINGS = """
actuator_msgs Actuators=Actuators
builtin_interfaces Time=Time
geometry_msgs Point=Vector3d Pose=Pose PoseArray=Pose_V PoseStamped=Pose
geometry_msgs PoseWithCovariance=PoseWithCovariance PoseWithCovarianceStamped=PoseWithCovariance
geometry_msgs Quaternion=Quaternion Transform=Pose TransformStamped=Pose Twist=Twist
geometry_msgs TwistStamped=Twist TwistWithCovariance=TwistWithCovariance Vector3=Vector3d
geometry_msgs TwistWithCovarianceStamped=TwistWithCovariance Wrench=Wrench WrenchStamped=Wrench
gps_msgs GPSFix=NavSat
nav_msgs Odometry=Odometry Odometry=OdometryWithCovariance
rcl_interfaces ParameterValue=Any
ros_gz_interfaces Altimeter=Altimeter Contact=Contact Contacts=Contacts Dataframe=Dataframe
ros_gz_interfaces Entity=Entity EntityWrench=EntityWrench Float32Array=Float_V
ros_gz_interfaces GuiCamera=GUICamera JointWrench=JointWrench Light=Light
ros_gz_interfaces MaterialColor=MaterialColor ParamVec=Param ParamVec=Param_V
ros_gz_interfaces SensorNoise=SensorNoise StringVec=StringMsg_V TrackVisual=TrackVisual
ros_gz_interfaces VideoRecord=VideoRecord
rosgraph_msgs Clock=Clock
sensor_msgs BatteryState=BatteryState CameraInfo=CameraInfo FluidPressure=FluidPressure
sensor_msgs Image=Image Imu=IMU JointState=Model Joy=Joy LaserScan=LaserScan
sensor_msgs MagneticField=Magnetometer NavSatFix=NavSat PointCloud2=PointCloudPacked
std_msgs Bool=Boolean ColorRGBA=Color Empty=Empty Float32=Float Float64=Double Header=Header
std_msgs Int32=Int32 UInt32=UInt32 String=StringMsg
tf2_msgs TFMessage=Pose_V
trajectory_msgs JointTrajectory=JointTrajectory
vision_msgs Detection2DArray=AnnotatedAxisAligned2DBox_V Detection2D=AnnotatedAxisAligned2DBox
vision_msgs Detection3DArray=AnnotatedOriented3DBox_V Detection3D=AnnotatedOriented3DBox
"""
BRIDGED_TYPES: frozenset[tuple[str, str]] = frozenset(
    (f"{package}/msg/{ros}", f"gz.msgs.{gz}")
    for package, *pairs in map(str.split, _MAPPINGS.strip().splitlines())
    for ros, _, gz in (pair.partition("=") for pair in pairs)
)
"""The supported pairs of ROS and Gazebo types."""


class BridgeEntry(NamedTuple):
    """One connection."""

    path: str
    location: Location
    keys: dict[str, Scalar]
    """The keys by their text."""
    values: dict[str, Scalar]
    """The scalar values by key."""

    def text(self, key: str) -> str:
        """Return a value; empty if there is none."""
        value = self.values.get(key)
        return value.text if value is not None else ""

    @property
    def ros_topic(self) -> str:
        """The ROS topic, which several keys may set."""
        names = map(self.text, ("ros_topic_name", "topic_name", "gz_topic_name"))
        return next(filter(None, names), "")

    @property
    def direction(self) -> str:
        """The direction; ``BIDIRECTIONAL`` by default."""
        return self.text("direction") or "BIDIRECTIONAL"


def bridge_roots(package: Package) -> list[tuple[str, yaml_tree.YamlNode | ParseError]]:
    """Return the configurations of bridges, each with the root of its YAML.

    If it is not YAML, with the error.
    """

    def find() -> list[tuple[str, yaml_tree.YamlNode | ParseError]]:
        result: list[tuple[str, yaml_tree.YamlNode | ParseError]] = []
        for path in package.files:
            if path.endswith((".yaml", ".yml")) and _is_candidate(package, path):
                try:
                    source = package.source(path)
                except ViewError:
                    continue
                try:
                    result += [(path, root) for root in yaml_tree.parse(source)[:1]]
                except ParseError as error:
                    result.append((path, error))
        return result

    return package.remember("bridge_files", find)


def bridge_entries(package: Package) -> Iterator[BridgeEntry]:
    """Yield the connections of all bridges of a package."""
    for path, root in bridge_roots(package):
        for item in root.items if isinstance(root, Sequence) else ():
            if isinstance(item, Mapping):
                values = {key.text: value for key, value in item.pairs if isinstance(value, Scalar)}
                keys = {key.text: key for key, _ in item.pairs}
                first = item.pairs[0][0].location if item.pairs else item.location
                yield BridgeEntry(path, first, keys, values)


def _is_candidate(package: Package, path: str) -> bool:
    if not {"test", "tests"}.isdisjoint(path.split("/")):
        return False
    try:
        data = package.bytes_of(path)
    except OSError:
        return False
    return sum(mark.encode() in data for mark in _MARKS) >= _FEW
