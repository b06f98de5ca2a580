"""Recipes for the messages of nav_msgs."""

from __future__ import annotations

from scaffold.generate.payload.recipe import Recipe

_POSES = """
    for index in range(5):
        pose = PoseStamped()
        pose.header = msg.header
        pose.pose.position.x = float(index)  # meters
        pose.pose.position.y = math.sin(self.count / 10.0 + index)
        msg.{field}.append(pose)
"""

RECIPES: dict[str, Recipe] = {
    "Goals": Recipe(
        summary="five waypoints, which sway",
        code=_POSES.format(field="goals"),
        log="{len(msg.goals)} goals",
        checks=(
            "len(message.goals) == 5",
            "all(goal.header == message.header for goal in message.goals)",
        ),
        frame="map",
    ),
    "GridCells": Recipe(
        summary="a row of occupied cells that moves sideways",
        code="""
            msg.cell_width = 0.5  # meters
            msg.cell_height = 0.5
            y = 0.5 * (self.count % 10)
            msg.cells = [Point(x=0.5 * column, y=y) for column in range(5)]
        """,
        log="{len(msg.cells)} cells at y {msg.cells[0].y:.1f} m",
        checks=("len(message.cells) == 5", "message.cell_width == 0.5"),
        frame="map",
    ),
    "MapMetaData": Recipe(
        summary="the size and the place of a map",
        code="""
            msg.map_load_time = self.get_clock().now().to_msg()
            msg.resolution = 0.05  # meters per cell
            msg.width = 100  # cells
            msg.height = 60
            msg.origin.position.x = -2.5  # meters: where the first cell is
            msg.origin.position.y = -1.5
        """,
        log="{msg.width} x {msg.height} cells",
        checks=("(message.width, message.height) == (100, 60)", "message.map_load_time.sec > 0"),
    ),
    "OccupancyGrid": Recipe(
        summary="a map with a wall that moves to the right",
        constants="""
            WIDTH = 20  # cells
            HEIGHT = 10
        """,
        code="""
            msg.info.map_load_time = msg.header.stamp
            msg.info.resolution = 0.1  # meters per cell
            msg.info.width = WIDTH
            msg.info.height = HEIGHT
            row = [0] * WIDTH  # free
            row[self.count % WIDTH] = 100  # occupied
            msg.data = row * HEIGHT
        """,
        log="{msg.info.width} x {msg.info.height} cells",
        checks=(
            "len(message.data) == message.info.width * message.info.height == 20 * 10",
            "message.data.count(100) == message.info.height",
        ),
    ),
    "Odometry": Recipe(
        summary="the pose and the velocity of a robot that drives on a circle",
        code="""
            msg.child_frame_id = 'base_link'
            seconds = msg.header.stamp.sec + msg.header.stamp.nanosec / 1e9
            angle = 0.2 * seconds  # radians
            msg.pose.pose.position.x = math.sin(angle)  # meters
            msg.pose.pose.position.y = 1.0 - math.cos(angle)
            msg.pose.pose.orientation.z = math.sin(angle / 2.0)  # a turn about the vertical axis
            msg.pose.pose.orientation.w = math.cos(angle / 2.0)
            msg.pose.covariance[::7] = 0.01  # the diagonal
            msg.twist.twist.linear.x = 0.2  # meters per second
            msg.twist.twist.angular.z = 0.2  # radians per second
            msg.twist.covariance[::7] = 0.01
        """,
        log="x {msg.pose.pose.position.x:.2f} m",
        checks=(
            "message.child_frame_id == 'base_link'",
            (
                "message.pose.pose.position.x == pytest.approx(\n"
                "    2.0 * message.pose.pose.orientation.z * message.pose.pose.orientation.w,\n"
                "    abs=1e-6)"
            ),
            (
                "message.pose.pose.position.y == pytest.approx(\n"
                "    2.0 * message.pose.pose.orientation.z**2, abs=1e-6)"
            ),
            (
                "message.pose.pose.orientation.w == pytest.approx(\n"
                "    math.cos(0.1 * ("
                "message.header.stamp.sec + message.header.stamp.nanosec / 1e9)),\n"
                "    abs=1e-6)"
            ),
            "message.pose.covariance[35] == message.twist.covariance[0] == 0.01",
        ),
    ),
    "Path": Recipe(
        summary="a path of five poses that sways",
        code=_POSES.format(field="poses"),
        log="{len(msg.poses)} poses",
        checks=(
            "len(message.poses) == 5",
            "all(pose.header == message.header for pose in message.poses)",
            "[pose.pose.position.x for pose in message.poses] == [0.0, 1.0, 2.0, 3.0, 4.0]",
            "len({pose.pose.position.y for pose in message.poses}) == 5",
        ),
    ),
}
