"""Recipes for the messages of unique_identifier_msgs."""

from __future__ import annotations

from scaffold.generate.payload.recipe import Recipe

RECIPES: dict[str, Recipe] = {
    "UUID": Recipe(
        summary="a new random identifier each time",
        code="msg.uuid = list(uuid.uuid4().bytes)",
        log="{uuid.UUID(bytes=bytes(msg.uuid))}",
        checks=("len(message.uuid) == 16", "any(message.uuid)"),
    ),
}
