"""Recipes for the messages of geometry_msgs: something that moves on a circle."""

from __future__ import annotations

from scaffold.generate.payload.recipe import Recipe

_POINT = Recipe(
    summary="a point that moves on a circle of 1 meter radius",
    code="""
        angle = self.count / 10.0  # radians
        msg.x = math.cos(angle)  # meters
        msg.y = math.sin(angle)
    """,
    log="x {msg.x:.2f} m, y {msg.y:.2f} m",
    checks=("message.x**2 + message.y**2 == pytest.approx(1.0)",),
    frame="map",
)
_SQUARE = """
    side = 2.0 + math.sin(self.count / 10.0)  # meters
    corners = [(0.0, 0.0), (side, 0.0), (side, side), (0.0, side)]
    msg{path}.points = [Point32(x=x, y=y) for x, y in corners]
"""

RECIPES: dict[str, Recipe] = {
    "Accel": Recipe(
        summary="the acceleration of a robot that speeds up and slows down",
        code="msg.linear.x = 0.5 * math.sin(self.count / 10.0)  # meters per second squared",
        log="{msg.linear.x:.2f} m/s^2",
        checks=("-0.5 <= message.linear.x <= 0.5",),
    ),
    "AccelWithCovariance": Recipe(
        summary="the acceleration of a robot that speeds up and slows down",
        code="""
            msg.accel.linear.x = 0.5 * math.sin(self.count / 10.0)  # meters per second squared
            msg.covariance[::7] = 0.01  # the diagonal
        """,
        log="{msg.accel.linear.x:.2f} m/s^2",
        checks=("-0.5 <= message.accel.linear.x <= 0.5", "message.covariance[0] > 0.0"),
    ),
    "Inertia": Recipe(
        summary="the inertia of a solid ball whose mass changes",
        code="""
            msg.m = 2.0 + math.sin(self.count / 10.0)  # kilograms
            msg.com.z = 0.1  # meters
            moment = 0.4 * msg.m * 0.1**2  # kilograms times meters squared
            msg.ixx = moment
            msg.iyy = moment
            msg.izz = moment
        """,
        log="{msg.m:.2f} kg",
        checks=("1.0 <= message.m <= 3.0", "message.ixx == message.iyy == message.izz"),
    ),
    "Point": _POINT,
    "Point32": _POINT,
    "Polygon": Recipe(
        summary="a square that grows and shrinks",
        code=_SQUARE.format(path=""),
        log="{msg.points[2].x:.2f} m wide",
        checks=("len(message.points) == 4",),
        frame="map",
    ),
    "PolygonInstance": Recipe(
        summary="a square that grows and shrinks, with a number",
        code=_SQUARE.format(path=".polygon") + "    msg.id = 1",
        log="{msg.polygon.points[2].x:.2f} m wide",
        checks=("len(message.polygon.points) == 4",),
        frame="map",
    ),
    "Pose": Recipe(
        summary="a pose on a circle of 1 meter radius, heading along it",
        code="""
            angle = self.count / 10.0  # radians
            msg.position.x = math.cos(angle)  # meters
            msg.position.y = math.sin(angle)
            heading = angle + math.pi / 2.0
            msg.orientation.z = math.sin(heading / 2.0)  # a turn about the vertical axis
            msg.orientation.w = math.cos(heading / 2.0)
        """,
        log="x {msg.position.x:.2f} m, y {msg.position.y:.2f} m",
        checks=(
            "message.position.x**2 + message.position.y**2 == pytest.approx(1.0)",
            (
                "message.position.x == pytest.approx(\n"
                "    2.0 * message.orientation.z * message.orientation.w, abs=1e-6)"
            ),
            "message.position.y == pytest.approx(2.0 * message.orientation.z**2 - 1.0, abs=1e-6)",
        ),
        frame="map",
    ),
    "Pose2D": Recipe(
        summary="a pose on a circle of 1 meter radius, heading along it",
        code="""
            angle = self.count / 10.0  # radians
            msg.x = math.cos(angle)  # meters
            msg.y = math.sin(angle)
            msg.theta = angle + math.pi / 2.0  # radians
        """,
        log="x {msg.x:.2f} m, y {msg.y:.2f} m",
        checks=("message.x**2 + message.y**2 == pytest.approx(1.0)",),
    ),
    "PoseArray": Recipe(
        summary="a row of poses that moves forward and back",
        code="""
            for index in range(5):
                pose = Pose()
                pose.position.x = math.sin(self.count / 10.0)  # meters
                pose.position.y = 0.5 * index
                msg.poses.append(pose)
        """,
        log="{len(msg.poses)} poses",
        checks=(
            "len(message.poses) == 5",
            "all(pose.orientation.w == 1.0 for pose in message.poses)",
        ),
        frame="map",
    ),
    "PoseWithCovariance": Recipe(
        summary="an uncertain pose on a circle of 1 meter radius, heading along it",
        code="""
            angle = self.count / 10.0  # radians
            msg.pose.position.x = math.cos(angle)  # meters
            msg.pose.position.y = math.sin(angle)
            heading = angle + math.pi / 2.0
            msg.pose.orientation.z = math.sin(heading / 2.0)  # a turn about the vertical axis
            msg.pose.orientation.w = math.cos(heading / 2.0)
            msg.covariance[::7] = 0.01  # the diagonal: meters squared, radians squared
        """,
        log="x {msg.pose.position.x:.2f} m",
        checks=(
            (
                "message.pose.position.x == pytest.approx(\n"
                "    2.0 * message.pose.orientation.z * message.pose.orientation.w, abs=1e-6)"
            ),
            (
                "message.pose.position.y == pytest.approx(\n"
                "    2.0 * message.pose.orientation.z**2 - 1.0, abs=1e-6)"
            ),
            "message.covariance[35] == 0.01",
        ),
        frame="map",
    ),
    "Quaternion": Recipe(
        summary="a rotation about the vertical axis",
        code="""
            angle = self.count / 10.0  # radians
            msg.z = math.sin(angle / 2.0)
            msg.w = math.cos(angle / 2.0)
        """,
        log="z {msg.z:.3f}, w {msg.w:.3f}",
        checks=("message.z**2 + message.w**2 == pytest.approx(1.0)",),
        frame="map",
    ),
    "Transform": Recipe(
        summary="a transform that circles around the origin and turns",
        code="""
            angle = self.count / 10.0  # radians
            msg.translation.x = math.cos(angle)  # meters
            msg.translation.y = math.sin(angle)
            msg.rotation.z = math.sin(angle / 2.0)  # a turn about the vertical axis
            msg.rotation.w = math.cos(angle / 2.0)
        """,
        log="x {msg.translation.x:.2f} m",
        checks=("message.rotation.z**2 + message.rotation.w**2 == pytest.approx(1.0)",),
        frame="map",
    ),
    "TransformStamped": Recipe(
        summary="the pose of a frame that circles around the origin and turns",
        code="""
            msg.child_frame_id = 'base_link'
            angle = self.count / 10.0  # radians
            msg.transform.translation.x = math.cos(angle)  # meters
            msg.transform.translation.y = math.sin(angle)
            msg.transform.rotation.z = math.sin(angle / 2.0)  # a turn about the vertical axis
            msg.transform.rotation.w = math.cos(angle / 2.0)
        """,
        log="x {msg.transform.translation.x:.2f} m",
        checks=(
            "message.child_frame_id == 'base_link'",
            "-1.0 <= message.transform.translation.x <= 1.0",
        ),
        frame="map",
    ),
    "Twist": Recipe(
        summary="the velocity of a robot that drives forward in curves",
        code="""
            msg.linear.x = 0.5  # meters per second
            msg.angular.z = math.sin(self.count / 10.0)  # radians per second
        """,
        log="{msg.angular.z:.2f} rad/s",
        checks=("message.linear.x == 0.5", "-1.0 <= message.angular.z <= 1.0"),
    ),
    "TwistWithCovariance": Recipe(
        summary="the measured velocity of a robot that drives forward in curves",
        code="""
            msg.twist.linear.x = 0.5  # meters per second
            msg.twist.angular.z = math.sin(self.count / 10.0)  # radians per second
            msg.covariance[::7] = 0.01  # the diagonal
        """,
        log="{msg.twist.angular.z:.2f} rad/s",
        checks=("-1.0 <= message.twist.angular.z <= 1.0", "message.covariance[35] > 0.0"),
    ),
    "Vector3": Recipe(
        summary="a vector of length 1 that turns about the vertical axis",
        code="""
            angle = self.count / 10.0  # radians
            msg.x = math.cos(angle)
            msg.y = math.sin(angle)
        """,
        log="x {msg.x:.2f}, y {msg.y:.2f}",
        checks=("message.x**2 + message.y**2 == pytest.approx(1.0)",),
    ),
    "VelocityStamped": Recipe(
        summary="the velocity of a robot that drives forward in curves",
        code="""
            msg.body_frame_id = 'base_link'
            msg.reference_frame_id = 'odom'
            msg.velocity.linear.x = 0.5  # meters per second
            msg.velocity.angular.z = math.sin(self.count / 10.0)  # radians per second
        """,
        log="{msg.velocity.angular.z:.2f} rad/s",
        checks=("-1.0 <= message.velocity.angular.z <= 1.0",),
    ),
    "Wrench": Recipe(
        summary="the weight of a load that swings",
        code="""
            msg.force.x = math.sin(self.count / 10.0)  # newtons
            msg.force.z = -9.81  # newtons: 1 kilogram
            msg.torque.y = 0.1 * msg.force.x  # newton meters
        """,
        log="x {msg.force.x:.2f} N, z {msg.force.z:.2f} N",
        checks=("-1.0 <= message.force.x <= 1.0",),
        frame="tool0",
    ),
}
