"""ND092: what is written as a node inherits from Node."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, RclpyRule, Report
from scaffold.api.rclpy import RclpyFile

_CREATES = ("create_publisher", "create_subscription", "create_timer", "declare_parameter")
_NODE = (
    "from rclpy.node import Node\n\n\n"
    "class Talker{}:\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "        self.create_timer(1.0, print)\n"
)


class NodeWithoutBase(RclpyRule):
    """A class uses methods of Node, but does not inherit from it.

    **Why.** ``TypeError: object.__init__() takes exactly one argument``, or ``AttributeError:
    'Talker' object has no attribute 'create_timer'``.

    **Fix.** Write ``class Talker(Node):``.

    **Source.** ROS 2 documentation, "Writing a simple publisher and subscriber (Python)".
    """

    code = "ND092"
    name = "node-without-base"
    examples = (
        Example("a node", {"talker.py": _NODE.format("(Node)")}),
        Example(
            "a part of nodes, which another class takes in",
            {"talker.py": _NODE.format("") + "\n\nclass Both(Node, Talker):\n    pass\n"},
        ),
        Example(
            "none",
            {"talker.py": _NODE.format("")},
            reports=(
                Report(
                    "talker.py:4:7", "Talker uses methods of Node, but does not inherit from it"
                ),
            ),
        ),
        Example(
            "any object",
            {"talker.py": _NODE.format("(object)")},
            reports=(
                Report(
                    "talker.py:4:7", "Talker uses methods of Node, but does not inherit from it"
                ),
            ),
        ),
    )

    def check_file(self, facts: RclpyFile) -> Iterator[Diagnostic]:
        for class_ in facts.module.classes.values():
            if _lacks_base(facts, class_.node):
                message = f"{class_.name} uses methods of Node, but does not inherit from it"
                yield self.report(class_, message)


def _lacks_base(facts: RclpyFile, class_: ast.ClassDef) -> bool:
    """Tell whether a class without bases treats itself as a node."""
    bases = [base.id if isinstance(base, ast.Name) else "?" for base in class_.bases]
    if [one for one in bases if one != "object"] or class_.keywords or class_.decorator_list:
        return False
    text = facts.module.source.text
    if class_.name in {base for other in facts.module.walk(ast.ClassDef) for base in _bases(other)}:
        return False
    own = {*facts.module.index.bindings(class_)}
    return any(
        f"self.{name}(" in text
        and name not in own
        and any(
            facts.evaluator.self_class(one.value) is class_ and not facts.evaluator.stores(name)
            for one in facts.module.index.attributes(name)
        )
        for name in _CREATES
    )


def _bases(class_: ast.ClassDef) -> list[str]:
    return [base.id for base in class_.bases if isinstance(base, ast.Name)]
