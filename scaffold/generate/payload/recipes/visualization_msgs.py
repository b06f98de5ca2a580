"""Recipes for the messages of visualization_msgs."""

from __future__ import annotations

from scaffold.generate.payload.recipe import Recipe

_MARKER = """
    {marker}.ns = '{package}'
    {marker}.type = Marker.SPHERE
    {marker}.action = Marker.ADD
    angle = self.count / 10.0  # radians
    {marker}.pose.position.x = math.cos(angle)  # meters
    {marker}.pose.position.y = math.sin(angle)
    {marker}.scale = Vector3(x=0.2, y=0.2, z=0.2)  # meters
    {marker}.color = ColorRGBA(r=1.0, a=1.0)  # red, opaque
"""

RECIPES: dict[str, Recipe] = {
    "ImageMarker": Recipe(
        summary="a red circle around a place in an image that moves",
        code="""
            msg.ns = 'example'
            msg.type = ImageMarker.CIRCLE
            msg.action = ImageMarker.ADD
            msg.position.x = 320.0 + 100.0 * math.sin(self.count / 10.0)  # pixels
            msg.position.y = 240.0
            msg.scale = 20.0  # pixels
            msg.outline_color = ColorRGBA(r=1.0, a=1.0)  # red, opaque
        """,
        log="a circle at x {msg.position.x:.1f}",
        checks=("message.type == ImageMarker.CIRCLE", "220.0 <= message.position.x <= 420.0"),
        frame="camera_optical_frame",
    ),
    "InteractiveMarker": Recipe(
        summary="a marker that can be moved along an axis, and circles by itself",
        code="""
            msg.name = 'target'
            msg.description = 'Where to go'
            msg.scale = 1.0  # meters
            angle = self.count / 10.0  # radians
            msg.pose.position.x = math.cos(angle)  # meters
            msg.pose.position.y = math.sin(angle)
            control = InteractiveMarkerControl()
            control.name = 'move_x'
            control.interaction_mode = InteractiveMarkerControl.MOVE_AXIS
            msg.controls = [control]
        """,
        log="{msg.name} at x {msg.pose.position.x:.2f} m",
        checks=("message.name == 'target'", "len(message.controls) == 1"),
        frame="map",
    ),
    "InteractiveMarkerControl": Recipe(
        summary="a handle that moves a marker along an axis",
        code="""
            angle = self.count / 10.0  # radians
            msg.name = 'move'
            msg.orientation.z = math.sin(angle / 2.0)  # a turn about the vertical axis
            msg.orientation.w = math.cos(angle / 2.0)
            msg.orientation_mode = InteractiveMarkerControl.FIXED
            msg.interaction_mode = InteractiveMarkerControl.MOVE_AXIS
            msg.always_visible = True
        """,
        log="{msg.name}, turned to z {msg.orientation.z:.2f}",
        checks=("message.interaction_mode == InteractiveMarkerControl.MOVE_AXIS",),
    ),
    "InteractiveMarkerFeedback": Recipe(
        summary="a marker that a user drags on a circle",
        code="""
            msg.client_id = 'example'
            msg.marker_name = 'target'
            msg.control_name = 'move_x'
            msg.event_type = InteractiveMarkerFeedback.POSE_UPDATE
            angle = self.count / 10.0  # radians
            msg.pose.position.x = math.cos(angle)  # meters
            msg.pose.position.y = math.sin(angle)
        """,
        log="{msg.marker_name} at x {msg.pose.position.x:.2f} m",
        checks=("message.event_type == InteractiveMarkerFeedback.POSE_UPDATE",),
        frame="map",
    ),
    "InteractiveMarkerInit": Recipe(
        summary="all markers of a server: one that circles",
        code="""
            msg.server_id = 'example'
            msg.seq_num = self.count
            angle = self.count / 10.0  # radians
            marker = InteractiveMarker()
            marker.header.stamp = self.get_clock().now().to_msg()
            marker.header.frame_id = self.frame_id
            marker.name = 'target'
            marker.scale = 1.0  # meters
            marker.pose.position.x = math.cos(angle)  # meters
            marker.pose.position.y = math.sin(angle)
            msg.markers = [marker]
        """,
        log="{len(msg.markers)} marker",
        checks=("len(message.markers) == 1", "message.markers[0].name == 'target'"),
        frame="map",
    ),
    "InteractiveMarkerPose": Recipe(
        summary="the pose of a marker that circles",
        code="""
            msg.name = 'target'
            angle = self.count / 10.0  # radians
            msg.pose.position.x = math.cos(angle)  # meters
            msg.pose.position.y = math.sin(angle)
        """,
        log="{msg.name} at x {msg.pose.position.x:.2f} m",
        checks=("message.name == 'target'", "-1.0 <= message.pose.position.x <= 1.0"),
        frame="map",
    ),
    "InteractiveMarkerUpdate": Recipe(
        summary="the new pose of a marker that circles",
        code="""
            msg.server_id = 'example'
            msg.seq_num = self.count
            msg.type = InteractiveMarkerUpdate.UPDATE
            angle = self.count / 10.0  # radians
            pose = InteractiveMarkerPose(name='target')
            pose.header.stamp = self.get_clock().now().to_msg()
            pose.header.frame_id = self.frame_id
            pose.pose.position.x = math.cos(angle)  # meters
            pose.pose.position.y = math.sin(angle)
            msg.poses = [pose]
        """,
        log="x {msg.poses[0].pose.position.x:.2f} m",
        checks=("message.type == InteractiveMarkerUpdate.UPDATE", "len(message.poses) == 1"),
        frame="map",
    ),
    "Marker": Recipe(
        summary="a red ball that moves on a circle",
        code=_MARKER.format(marker="msg", package="example"),
        log="a ball at x {msg.pose.position.x:.2f} m",
        checks=("message.type == Marker.SPHERE", "message.color.a == 1.0"),
    ),
    "MarkerArray": Recipe(
        summary="three balls that move on a circle",
        code="""
            stamp = self.get_clock().now().to_msg()
            for index in range(3):
                angle = self.count / 10.0 + index  # radians
                marker = Marker()
                marker.header.stamp = stamp
                marker.header.frame_id = self.frame_id
                marker.ns = 'example'
                marker.id = index
                marker.type = Marker.SPHERE
                marker.pose.position.x = math.cos(angle)  # meters
                marker.pose.position.y = math.sin(angle)
                marker.scale = Vector3(x=0.2, y=0.2, z=0.2)  # meters
                marker.color = ColorRGBA(r=1.0, a=1.0)  # red, opaque
                msg.markers.append(marker)
        """,
        log="{len(msg.markers)} balls",
        checks=(
            "[marker.id for marker in message.markers] == [0, 1, 2]",
            "all(abs(time.time() - marker.header.stamp.sec) < 60 for marker in message.markers)",
            "{marker.type for marker in message.markers} == {Marker.SPHERE}",
            "len({marker.pose.position.x for marker in message.markers}) == 3",
            "len({marker.pose.position.y for marker in message.markers}) == 3",
            "all(marker.scale.x == 0.2 and marker.color.r == 1.0 for marker in message.markers)",
        ),
    ),
    "MenuEntry": Recipe(
        summary="an entry of a menu",
        code="""
            msg.id = self.count % 100 + 1
            msg.parent_id = 0  # on the first level
            msg.title = f'Entry {msg.id}'
            msg.command_type = MenuEntry.FEEDBACK
        """,
        log="{msg.title}",
        checks=("message.title == f'Entry {message.id}'",),
    ),
    "MeshFile": Recipe(
        summary="a file with a triangle that grows",
        code="""
            size = self.count % 10 + 1  # meters
            lines = ['solid triangle', 'facet normal 0 0 1', 'outer loop', 'vertex 0 0 0']
            lines += [f'vertex {size} 0 0', f'vertex 0 {size} 0', 'endloop', 'endfacet']
            lines += ['endsolid triangle']
            msg.filename = 'triangle.stl'
            msg.data = '\\n'.join(lines).encode()
        """,
        log="{msg.filename}, {len(msg.data)} bytes",
        checks=("message.filename == 'triangle.stl'", "bytes(message.data[:5]) == b'solid'"),
    ),
    "UVCoordinate": Recipe(
        summary="a place on a texture that moves",
        code="""
            msg.u = 0.5 + 0.5 * math.sin(self.count / 10.0)  # 0.0 to 1.0
            msg.v = 0.5
        """,
        log="u {msg.u:.2f}, v {msg.v:.2f}",
        checks=("0.0 <= message.u <= 1.0", "message.v == 0.5"),
    ),
}
