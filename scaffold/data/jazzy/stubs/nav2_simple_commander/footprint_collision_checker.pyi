from typing import Any

from geometry_msgs.msg import Polygon
from nav2_simple_commander.costmap_2d import PyCostmap2D as PyCostmap2D

NO_INFORMATION: int
LETHAL_OBSTACLE: int
INSCRIBED_INFLATED_OBSTACLE: int
MAX_NON_OBSTACLE: int
FREE_SPACE: int

class FootprintCollisionChecker:
    costmap_: Any
    def __init__(self) -> None: ...
    def footprintCost(self, footprint: Polygon) -> float: ...
    def lineCost(
        self, x0: float, x1: float, y0: float, y1: float, step_size: float = 0.5
    ) -> float: ...
    def worldToMapValidated(self, wx: float, wy: float) -> Any: ...
    def pointCost(self, x: int, y: int) -> float: ...
    def setCostmap(self, costmap: PyCostmap2D) -> None: ...
    def footprintCostAtPose(
        self, x: float, y: float, theta: float, footprint: Polygon
    ) -> float: ...
