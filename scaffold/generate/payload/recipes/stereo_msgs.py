"""Recipes for the messages of stereo_msgs."""

from __future__ import annotations

from scaffold.generate.payload.recipe import Recipe

RECIPES: dict[str, Recipe] = {
    "DisparityImage": Recipe(
        summary="the disparity of a wall that moves to and from two cameras",
        constants="""
            WIDTH = 64  # pixels
            HEIGHT = 48
        """,
        code="""
            disparity = 20.0 + 10.0 * math.sin(self.count / 10.0)  # pixels
            msg.image.header = msg.header
            msg.image.width = WIDTH
            msg.image.height = HEIGHT
            msg.image.encoding = '32FC1'  # one float per pixel
            msg.image.step = 4 * WIDTH  # bytes per row
            msg.image.data = struct.pack('<f', disparity) * WIDTH * HEIGHT
            msg.f = 500.0  # focal length in pixels
            msg.t = 0.1  # meters between the cameras
            msg.min_disparity = 1.0  # pixels
            msg.max_disparity = 64.0
            msg.delta_d = 0.125
        """,
        log="{msg.image.width} x {msg.image.height} pixels",
        checks=(
            "len(message.image.data) == message.image.height * message.image.step",
            "message.min_disparity < message.max_disparity",
        ),
    ),
}
