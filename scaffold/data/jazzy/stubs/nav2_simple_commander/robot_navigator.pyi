from collections.abc import Sequence
from enum import Enum
from typing import Any

from geometry_msgs.msg import PoseStamped as PoseStamped
from nav_msgs.msg import OccupancyGrid, Path
from rclpy.node import Node as Node

# What the module imports itself.
Duration: Any
ActionClient: Any
AssistedTeleop: Any
BackUp: Any
ClearCostmapAroundPose: Any
ClearCostmapAroundRobot: Any
ClearCostmapExceptRegion: Any
ClearEntireCostmap: Any
ComputePathThroughPoses: Any
ComputePathToPose: Any
DockRobot: Any
DriveOnHeading: Any
FollowGPSWaypoints: Any
FollowPath: Any
FollowWaypoints: Any
GetCostmap: Any
GetState: Any
GoalStatus: Any
LoadMap: Any
ManageLifecycleNodes: Any
NavigateThroughPoses: Any
NavigateToPose: Any
Point: Any
PoseWithCovarianceStamped: Any
QoSDurabilityPolicy: Any
QoSHistoryPolicy: Any
QoSProfile: Any
QoSReliabilityPolicy: Any
SmoothPath: Any
Spin: Any
UndockRobot: Any
rclpyDuration: Any

class TaskResult(Enum):
    UNKNOWN = 0
    SUCCEEDED = 1
    CANCELED = 2
    FAILED = 3

class BasicNavigator(Node):
    initial_pose: PoseStamped
    initial_pose_received: bool
    goal_handle: Any
    result_future: Any
    feedback: Any
    status: Any
    nav_through_poses_client: Any
    nav_to_pose_client: Any
    follow_waypoints_client: Any
    follow_gps_waypoints_client: Any
    follow_path_client: Any
    compute_path_to_pose_client: Any
    compute_path_through_poses_client: Any
    smoother_client: Any
    spin_client: Any
    backup_client: Any
    drive_on_heading_client: Any
    assisted_teleop_client: Any
    docking_client: Any
    undocking_client: Any
    localization_pose_sub: Any
    initial_pose_pub: Any
    change_maps_srv: Any
    clear_costmap_global_srv: Any
    clear_costmap_local_srv: Any
    get_costmap_global_srv: Any
    get_costmap_local_srv: Any
    def __init__(self, node_name: str = "basic_navigator", namespace: str = "") -> None: ...
    def destroyNode(self) -> None: ...
    def setInitialPose(self, initial_pose: PoseStamped) -> None: ...
    def goThroughPoses(self, poses: Sequence[PoseStamped], behavior_tree: str = "") -> Any: ...
    def goToPose(self, pose: PoseStamped, behavior_tree: str = "") -> Any: ...
    def followWaypoints(self, poses: Sequence[PoseStamped]) -> Any: ...
    def followGpsWaypoints(self, gps_poses: Any) -> Any: ...
    def spin(
        self,
        spin_dist: float = 1.57,
        time_allowance: int = 10,
        disable_collision_checks: bool = False,
    ) -> Any: ...
    def backup(
        self,
        backup_dist: float = 0.15,
        backup_speed: float = 0.025,
        time_allowance: int = 10,
        disable_collision_checks: bool = False,
    ) -> Any: ...
    def driveOnHeading(
        self,
        dist: float = 0.15,
        speed: float = 0.025,
        time_allowance: int = 10,
        disable_collision_checks: bool = False,
    ) -> Any: ...
    def assistedTeleop(self, time_allowance: int = 30) -> Any: ...
    def followPath(self, path: Path, controller_id: str = "", goal_checker_id: str = "") -> Any: ...
    def dockRobotByPose(
        self, dock_pose: PoseStamped, dock_type: str, nav_to_dock: bool = True
    ) -> Any: ...
    def dockRobotByID(self, dock_id: str, nav_to_dock: bool = True) -> Any: ...
    def undockRobot(self, dock_type: str = "") -> Any: ...
    def cancelTask(self) -> None: ...
    def isTaskComplete(self) -> bool: ...
    def getFeedback(self) -> Any: ...
    def getResult(self) -> TaskResult: ...
    def waitUntilNav2Active(
        self, navigator: str = "bt_navigator", localizer: str = "amcl"
    ) -> None: ...
    def getPath(
        self,
        start: PoseStamped,
        goal: PoseStamped,
        planner_id: str = "",
        use_start: bool = False,
    ) -> Any: ...
    def getPathThroughPoses(
        self,
        start: PoseStamped,
        goals: Sequence[PoseStamped],
        planner_id: str = "",
        use_start: bool = False,
    ) -> Any: ...
    def smoothPath(
        self,
        path: Path,
        smoother_id: str = "",
        max_duration: float = 2.0,
        check_for_collision: bool = False,
    ) -> Any: ...
    def changeMap(self, map_filepath: str) -> Any: ...
    def clearAllCostmaps(self) -> None: ...
    def clearLocalCostmap(self) -> None: ...
    def clearGlobalCostmap(self) -> None: ...
    def clearCostmapExceptRegion(self, reset_distance: float) -> None: ...
    def clearCostmapAroundRobot(self, reset_distance: float) -> None: ...
    def clearCostmapAroundPose(self, pose: PoseStamped, reset_distance: float) -> None: ...
    def getGlobalCostmap(self) -> Any: ...
    def getLocalCostmap(self) -> Any: ...
    def lifecycleStartup(self) -> None: ...
    def lifecycleShutdown(self) -> None: ...
    def info(self, msg: str) -> None: ...
    def warn(self, msg: str) -> None: ...
    def error(self, msg: str) -> None: ...
    def debug(self, msg: str) -> None: ...
    _waitForNodeToActivate: Any
    _waitForInitialPose: Any
    _amclPoseCallback: Any
    _feedbackCallback: Any
    _setInitialPose: Any
    _getPathImpl: Any
    _smoothPathImpl: Any
