"""Recipes for the messages of tf2_msgs."""

from __future__ import annotations

from scaffold.generate.payload.recipe import Recipe

RECIPES: dict[str, Recipe] = {
    "TF2Error": Recipe(
        summary="a lookup that works and fails in turn",
        code="""
            if self.count % 2 == 0:
                msg.error = TF2Error.NO_ERROR
            else:
                msg.error = TF2Error.LOOKUP_ERROR
                msg.error_string = 'the frame is not known'
        """,
        log="error {msg.error}",
        checks=("message.error in (TF2Error.NO_ERROR, TF2Error.LOOKUP_ERROR)",),
    ),
    "TFMessage": Recipe(
        summary="the pose of a frame that circles around the origin and turns",
        code="""
            angle = self.count / 10.0  # radians
            transform = TransformStamped()
            transform.header.stamp = self.get_clock().now().to_msg()
            transform.header.frame_id = self.frame_id
            transform.child_frame_id = 'base_link'
            transform.transform.translation.x = math.cos(angle)  # meters
            transform.transform.translation.y = math.sin(angle)
            transform.transform.rotation.z = math.sin(angle / 2.0)  # about the vertical axis
            transform.transform.rotation.w = math.cos(angle / 2.0)
            msg.transforms = [transform]
        """,
        log="{msg.transforms[0].child_frame_id}",
        checks=("[one.child_frame_id for one in message.transforms] == ['base_link']",),
    ),
}
