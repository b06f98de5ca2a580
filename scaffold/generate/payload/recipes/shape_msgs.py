"""Recipes for the messages of shape_msgs."""

from __future__ import annotations

from scaffold.generate.payload.recipe import Recipe

RECIPES: dict[str, Recipe] = {
    "Mesh": Recipe(
        summary="a triangle that grows and shrinks",
        code="""
            size = 2.0 + math.sin(self.count / 10.0)  # meters
            msg.vertices = [Point(), Point(x=size), Point(y=size)]
            msg.triangles = [MeshTriangle(vertex_indices=[0, 1, 2])]
        """,
        log="{msg.vertices[1].x:.2f} m wide",
        checks=("len(message.vertices) == 3", "len(message.triangles) == 1"),
    ),
    "MeshTriangle": Recipe(
        summary="the numbers of three vertices that follow each other",
        code="""
            first = 3 * (self.count % 100)
            msg.vertex_indices = [first, first + 1, first + 2]
        """,
        log="{msg.vertex_indices.tolist()}",
        checks=("message.vertex_indices[2] == message.vertex_indices[0] + 2",),
    ),
    "Plane": Recipe(
        summary="a floor that moves up and down",
        code="""
            height = math.sin(self.count / 10.0)  # meters
            msg.coef = [0.0, 0.0, 1.0, -height]  # ax + by + cz + d = 0
        """,
        log="{msg.coef.tolist()}",
        checks=("message.coef[2] == 1.0",),
    ),
    "SolidPrimitive": Recipe(
        summary="a box that grows and shrinks",
        code="""
            msg.type = SolidPrimitive.BOX
            length = 2.0 + math.sin(self.count / 10.0)  # meters
            msg.dimensions = [length, 0.5, 0.2]  # in x, y and z
        """,
        log="a box of {msg.dimensions[0]:.2f} m",
        checks=("message.type == SolidPrimitive.BOX", "len(message.dimensions) == 3"),
    ),
}
