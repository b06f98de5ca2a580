"""Recipes for the messages of service_msgs."""

from __future__ import annotations

from scaffold.generate.payload.recipe import Recipe

RECIPES: dict[str, Recipe] = {
    "ServiceEventInfo": Recipe(
        summary="a request that a client with a fixed identifier sends",
        code="""
            msg.event_type = ServiceEventInfo.REQUEST_SENT
            msg.stamp = self.get_clock().now().to_msg()
            msg.client_gid = list(range(16))
            msg.sequence_number = self.count
        """,
        log="request {msg.sequence_number}",
        checks=(
            "message.event_type == ServiceEventInfo.REQUEST_SENT",
            "abs(time.time() - message.stamp.sec) < 60",
            "list(message.client_gid) == list(range(16))",
        ),
    ),
}
