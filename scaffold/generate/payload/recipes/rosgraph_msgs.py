"""Recipes for the messages of rosgraph_msgs."""

from __future__ import annotations

from scaffold.generate.payload.recipe import Recipe

RECIPES: dict[str, Recipe] = {
    "Clock": Recipe(
        summary="a simulated time that starts at zero and moves by 0.1 seconds",
        code="""
            msg.clock.sec = self.count // 10
            msg.clock.nanosec = self.count % 10 * 100_000_000
        """,
        log="{msg.clock.sec}.{msg.clock.nanosec:09d} s",
        checks=("message.clock.nanosec % 100_000_000 == 0",),
    ),
}
