"""Recipes for the messages of trajectory_msgs."""

from __future__ import annotations

from scaffold.generate.payload.recipe import Recipe

RECIPES: dict[str, Recipe] = {
    "JointTrajectory": Recipe(
        summary="a motion of two joints to a target and back",
        code="""
            msg.joint_names = ['shoulder', 'elbow']
            target = math.sin(self.count / 10.0)  # radians
            for seconds, angle in enumerate([0.0, target, 0.0]):
                point = JointTrajectoryPoint()
                point.positions = [angle, -angle]
                point.velocities = [0.0, 0.0]  # radians per second
                point.time_from_start.sec = seconds
                msg.points.append(point)
        """,
        log="to {msg.points[1].positions[0]:.2f} rad",
        checks=(
            "len(message.points) == 3",
            "all(len(point.positions) == len(message.joint_names) for point in message.points)",
            "all(list(point.velocities) == [0.0, 0.0] for point in message.points)",
            "[point.time_from_start.sec for point in message.points] == [0, 1, 2]",
        ),
    ),
    "JointTrajectoryPoint": Recipe(
        summary="the positions of two joints after one second",
        code="""
            angle = math.sin(self.count / 10.0)  # radians
            msg.positions = [angle, -angle]
            msg.velocities = [0.0, 0.0]  # radians per second
            msg.time_from_start.sec = 1
        """,
        log="{msg.positions[0]:.2f} rad",
        checks=("len(message.positions) == len(message.velocities) == 2",),
    ),
    "MultiDOFJointTrajectory": Recipe(
        summary="a flight to a height and back",
        code="""
            msg.joint_names = ['base']
            target = 2.0 + math.sin(self.count / 10.0)  # meters
            for seconds, height in enumerate([0.0, target, 0.0]):
                transform = Transform()
                transform.translation.z = height
                waypoint = MultiDOFJointTrajectoryPoint()
                waypoint.transforms = [transform]
                waypoint.time_from_start.sec = seconds
                msg.points.append(waypoint)
        """,
        log="{len(msg.points)} points",
        checks=("len(message.points) == 3", "message.joint_names == ['base']"),
        frame="map",
    ),
    "MultiDOFJointTrajectoryPoint": Recipe(
        summary="the height to reach after one second",
        code="""
            transform = Transform()
            transform.translation.z = 2.0 + math.sin(self.count / 10.0)  # meters
            msg.transforms = [transform]
            msg.velocities = [Twist()]
            msg.time_from_start.sec = 1
        """,
        log="{msg.transforms[0].translation.z:.2f} m",
        checks=("len(message.transforms) == len(message.velocities) == 1",),
    ),
}
