"""ND004: arguments are in the order that rclpy expects."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Edit, Example, Fix, RclpyRule, Report
from scaffold.api.rclpy import Endpoint, Entity, RclpyFile, Timer

_NODE = (
    "from rclpy.node import Node\nfrom std_msgs.msg import String\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "        self.create_publisher({}, 10)\n"
    "        self.create_timer({})\n\n"
    "    def tick(self):\n"
    "        pass\n"
)


class ArgumentsSwapped(RclpyRule):
    """The first two arguments of a ``create_...`` call are swapped.

    **Why.** ``create_timer`` takes the period first, ``create_publisher`` and the like the type:
    the node ends with ``TypeError`` or ``AttributeError`` at start.

    **Fix.** Swap them.

    **Source.** ``rclpy/node.py``.
    """

    code = "ND004"
    name = "arguments-swapped"
    examples = (
        Example("in order", {"talker.py": _NODE.format("String, 'chatter'", "0.5, self.tick")}),
        Example(
            "swapped",
            {"talker.py": _NODE.format("'chatter', String", "self.tick, 0.5")},
            Report(
                "8:31",
                "swapped arguments: the type comes first, then the name 'chatter'",
                fix="swap the arguments",
            ),
            Report(
                "9:27",
                "swapped arguments: create_timer() takes the period first, then the callback",
                fix="swap the arguments",
            ),
            fixed={"talker.py": _NODE.format("String, 'chatter'", "0.5, self.tick")},
        ),
    )

    def check_file(self, file: RclpyFile) -> Iterator[Diagnostic]:
        for entity in file.entities:
            wanted = self._wanted(file, entity)
            if wanted:
                first, second = entity.call.args[:2]
                path = file.module.path
                edits = (
                    Edit(path, *file.module.span(first), file.module.text(second)),
                    Edit(path, *file.module.span(second), file.module.text(first)),
                )
                at = file.module.location(first)
                yield self.report(at, wanted, Fix("swap the arguments", edits))

    def _wanted(self, file: RclpyFile, entity: Entity) -> str | None:
        """Return the message if the first two arguments are certainly swapped."""
        if len(entity.call.args) < 2:  # noqa: PLR2004  the two that may be swapped
            return None
        first, second = entity.call.args[:2]
        evaluate = file.evaluator.evaluate
        if isinstance(entity, Timer):
            is_callable = isinstance(first, ast.Lambda | ast.Attribute) and not isinstance(
                evaluate(first), int | float
            )
            if is_callable and isinstance(evaluate(second), int | float):
                return "swapped arguments: create_timer() takes the period first, then the callback"
        elif (
            isinstance(entity, Endpoint)
            and isinstance(evaluate(first), str)
            and file.interface(second) is not None
        ):
            return f"swapped arguments: the type comes first, then the name {evaluate(first)!r}"
        return None
