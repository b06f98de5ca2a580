"""Recipes for the messages of builtin_interfaces."""

from __future__ import annotations

from scaffold.generate.payload.recipe import Recipe

RECIPES: dict[str, Recipe] = {
    "Duration": Recipe(
        summary="a duration that grows by half a second each time",
        code="""
            msg.sec = self.count // 2  # seconds
            msg.nanosec = self.count % 2 * 500_000_000
        """,
        log="{msg.sec}.{msg.nanosec:09d} s",
        checks=("message.nanosec < 10**9",),
    ),
    "Time": Recipe(
        summary="the time of publication",
        code="""
            now = self.get_clock().now().to_msg()
            msg.sec = now.sec
            msg.nanosec = now.nanosec
        """,
        log="{msg.sec}.{msg.nanosec:09d} s",
        checks=("message.sec > 0", "message.nanosec < 10**9"),
    ),
}
