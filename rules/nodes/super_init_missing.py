"""ND001: a node class calls the constructor of Node."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Rule

_NODE = (
    "from rclpy.node import Node\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        {}\n"
    "        self.create_timer(1.0, print)\n"
)


class SuperInitMissing(Rule):
    """A subclass of Node has a constructor that does not call the one of Node.

    **Why.** The first use of the node ends in ``AttributeError: 'Talker' object has no attribute
    '_Node__...'``.

    **Fix.** Begin with ``super().__init__('name_of_the_node')``.

    **Source.** ROS 2 documentation, "Writing a simple publisher and subscriber (Python)".
    """

    code = "ND001"
    name = "super-init-missing"
    examples = (
        Example("called", {"talker.py": _NODE.format("super().__init__('talker')")}),
        Example(
            "called when it starts",
            {
                "talker.py": _NODE.format("self.count = 0")
                + "\n    def main(self):\n        super().__init__('talker')\n"
            },
        ),
        Example("forgotten", {"talker.py": _NODE.format("self.count = 0")}, at=("talker.py:5",)),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for facts in package.rclpy_files():
            for node in facts.classes:
                if node.calls_super_init or node.constructor is None or node.is_made_later:
                    continue
                at = facts.module.name_location(node.constructor)
                message = (
                    f"{node.name}.__init__() does not call super().__init__(): no node is made"
                )
                yield self.report(at, message)
