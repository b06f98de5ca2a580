"""ND092: classes that use Node methods inherit from Node."""

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
            "a mixin", {"talker.py": _NODE.format("") + "\n\nclass Both(Node, Talker):\n    pass\n"}
        ),
        Example(
            "no base class",
            {"talker.py": _NODE.format("")},
            Report("4:7", "class 'Talker' uses methods of Node; inherit from Node"),
        ),
        Example(
            "object as base class",
            {"talker.py": _NODE.format("(object)")},
            Report("4:7", "class 'Talker' uses methods of Node; inherit from Node"),
        ),
    )

    def check_file(self, file: RclpyFile) -> Iterator[Diagnostic]:
        for class_ in file.module.classes.values():
            if _lacks_base(file, class_.node):
                message = f"class {class_.name!r} uses methods of Node; inherit from Node"
                yield self.report(class_, message)


def _lacks_base(file: RclpyFile, class_: ast.ClassDef) -> bool:
    """Return whether a class without bases treats itself as a node."""
    bases = [base.id if isinstance(base, ast.Name) else "?" for base in class_.bases]
    if [base for base in bases if base != "object"] or class_.keywords or class_.decorator_list:
        return False
    text = file.module.source.text
    if class_.name in {base for other in file.module.walk(ast.ClassDef) for base in _bases(other)}:
        return False
    own = {*file.module.index.bindings(class_)}
    return any(
        f"self.{name}(" in text
        and name not in own
        and any(
            file.evaluator.self_class(use.value) is class_ and not file.evaluator.stores(name)
            for use in file.module.index.attributes(name)
        )
        for name in _CREATES
    )


def _bases(class_: ast.ClassDef) -> list[str]:
    return [base.id for base in class_.bases if isinstance(base, ast.Name)]
