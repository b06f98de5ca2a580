"""ND001: node classes call the constructor of Node."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, RclpyRule, Report, Severity
from scaffold.api.rclpy import NODE, NodeClass, RclpyFile, defined_by, has

_NODE = (
    "from rclpy.node import Node\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        {}\n"
    "        self.create_timer(1.0, print)\n"
)


class SuperInitMissing(RclpyRule):
    """A subclass of Node has a constructor that does not call Node's constructor.

    **Why.** The first use of the node raises ``AttributeError: 'Talker' object has no attribute
    '_Node__...'``.

    **Fix.** Start with ``super().__init__('name_of_the_node')``.

    **Source.** ROS 2 documentation, "Writing a simple publisher and subscriber (Python)".
    """

    code = "ND001"
    name = "super-init-missing"
    other_severities = {Severity.WARNING: "nothing in the file uses it as a node"}
    examples = (
        Example("called", {"talker.py": _NODE.format("super().__init__('talker')")}),
        Example(
            "called later",
            {
                "talker.py": _NODE.format("self.count = 0")
                + "\n    def main(self):\n        super().__init__('talker')\n"
            },
        ),
        Example(
            "missing",
            {"talker.py": _NODE.format("self.count = 0")},
            Report("5:9", "Talker.__init__() does not call super().__init__(): AttributeError"),
        ),
        Example(
            "a class that never is the node",
            {
                "talker.py": _NODE.format("self.node = node")
                .replace("(self)", "(self, node)")
                .replace("self.create", "self.node.create")
                + "\n\ndef main(node):\n    talker = Talker(node)\n    print(talker.node)\n"
            },
            Report(
                "5:9",
                "Talker.__init__() does not call super().__init__(): AttributeError "
                "as soon as it is used as a node",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "the class above Node",
            {"talker.py": _NODE.format("super(Node, self).__init__('talker')")},
            Report("6:9", "this super() skips the constructor of Node; write super()"),
        ),
        Example(
            "an unbound super",
            {"talker.py": _NODE.format("super(Talker).__init__('talker')")},
            Report("6:9", "super() with only a class is unbound; write super()"),
        ),
        Example(
            "self twice",
            {"talker.py": _NODE.format("super().__init__(self, 'talker')")},
            Report("6:9", "super() already passes self; the first argument is the node name"),
        ),
    )

    def check_file(self, file: RclpyFile) -> Iterator[Diagnostic]:
        for node in file.classes:
            skipped = _skipping(file, node)
            if skipped is not None:
                yield self.report(file.module.location(skipped[0]), skipped[1])
                continue
            if node.calls_super_init or node.constructor is None or node.is_made_later:
                continue
            at = file.module.name_location(node.constructor)
            message = f"{node.name}.__init__() does not call super().__init__(): AttributeError"
            if not _is_used_as_node(file, node):
                message += " as soon as it is used as a node"
                yield self.report(at, message, severity=Severity.WARNING)
                continue
            yield self.report(at, message)


def _skipping(file: RclpyFile, node: NodeClass) -> tuple[ast.Call, str] | None:
    """Return a use of ``super`` that does not reach the constructor of Node, and why."""
    for call in file.calls_in(node.constructor) if node.constructor else ():
        match call:
            case ast.Call(func=ast.Name(id="super"), args=[ast.Name() as first, _]):
                if file.module.qualified_name(first) == "rclpy.node.Node":
                    return call, "this super() skips the constructor of Node; write super()"
            case ast.Call(func=ast.Name(id="super"), args=[ast.Name()]):
                return call, "super() with only a class is unbound; write super()"
            case ast.Call(
                func=ast.Attribute(attr="__init__", value=ast.Call(func=ast.Name(id="super"))),
                args=[ast.Name(id="self"), *_],
            ):
                return call, "super() already passes self; the first argument is the node name"
    return None


def _is_used_as_node(file: RclpyFile, node: NodeClass) -> bool:
    """Tell whether code asks an object of a class for what Node has, or hands the object on."""
    own = defined_by(node)
    made_here = [
        call
        for call in file.module.walk(ast.Call)
        if file.evaluator.named_class(call.func) is node.node
    ]
    if not made_here:
        return True
    for name in file.module.walk(ast.Name):
        value = file.evaluator.self_class(name)
        if value is None:
            made = file.evaluator.single_value(name)
            value = file.evaluator.named_class(made.func) if isinstance(made, ast.Call) else None
        if value is not node.node or not isinstance(name.ctx, ast.Load):
            continue
        parent = file.module.parent(name)
        if not isinstance(parent, ast.Attribute):
            return True
        if parent.attr not in own and has(NODE, parent.attr):
            return True
    return any(
        not isinstance(file.module.parent(call), ast.Assign | ast.Expr | ast.Attribute)
        for call in made_here
    )
