"""ND132: methods set attributes, not local variables of the same name."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Effect, Example, Package, RclpyRule
from scaffold.api.rclpy import NodeClass, RclpyFile, is_used_elsewhere

_NODE = (
    "from rclpy.node import Node\nfrom std_msgs.msg import Bool\n\n\n"
    "class Gate(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('gate')\n"
    "        self.is_open = False\n"
    "        self.create_subscription(Bool, 'open', self.on_open, 10)\n"
    "        self.create_timer(1.0, self.tick)\n\n"
    "    def on_open(self, msg):\n"
    "        {} = msg.data\n"
    "        {}\n\n"
    "    def tick(self):\n"
    "        if self.is_open:\n"
    "            self.get_logger().info('open')\n"
)
_LOGGED = "self.get_logger().info(f'open: {is_open}')"


class LocalForAttribute(RclpyRule):
    """A method sets a local variable instead of the attribute of the same name.

    **Why.** The variable disappears when the method returns; the attribute keeps the value from the
    constructor, so other methods never see the new one.

    **Fix.** Write ``self.`` before the name.

    **Source.** Python tutorial, "Class and Instance Variables".
    """

    code = "ND132"
    name = "local-for-attribute"
    effect = Effect.WRONG_BEHAVIOR
    examples = (
        Example("the attribute set", {"gate.py": _NODE.format("self.is_open", "return")}),
        Example(
            "a local variable that is used", {"gate.py": _NODE.format("is_open", "return is_open")}
        ),
        Example(
            "an attribute that another module sets",
            {
                "gate.py": _NODE.format("is_open", _LOGGED),
                "other.py": "def open_(gate):\n    gate.is_open = True\n",
            },
        ),
        Example(
            "set like the attribute, and only logged",
            {"gate.py": _NODE.replace("msg.data", "False").format("is_open", _LOGGED)},
        ),
        Example(
            "measured value with the name of a parameter",
            {
                "gate.py": _NODE.replace("= False", "= self.get_parameter('open').value").format(
                    "is_open", _LOGGED
                )
            },
        ),
        Example(
            "only logged",
            {"gate.py": _NODE.format("is_open", _LOGGED)},
            "13:9: 'is_open' is a local variable of on_open(): self.is_open never changes; write "
            "self.is_open",
        ),
    )

    def check_in(self, package: Package, file: RclpyFile) -> Iterator[Diagnostic]:
        if file.module.in_tests or file.module.mentions("locals(", "setattr(", "exec("):
            return
        for class_ in file.classes:
            for method in class_.methods.values():
                for name in _only_logged(file, class_, method):
                    if not is_used_elsewhere(package, file, name.id):
                        message = (
                            f"{name.id!r} is a local variable of {method.name}(): "
                            f"self.{name.id} never changes; write self.{name.id}"
                        )
                        yield self.report(file.module.location(name), message)


def _only_logged(file: RclpyFile, class_: NodeClass, method: ast.AST) -> Iterator[ast.Name]:
    """Yield the first assignments of local names that a method only logs."""
    names: dict[str, list[ast.Name]] = {}
    for name in file.module.below(method, ast.Name):
        names.setdefault(name.id, []).append(name)
    for uses in names.values():
        stores = [name for name in uses if not isinstance(name.ctx, ast.Load)]
        loads = [name for name in uses if isinstance(name.ctx, ast.Load)]
        if not stores or not all(isinstance(file.module.parent(x), ast.Assign) for x in stores):
            continue
        if loads and all(_is_logged(file, name) for name in loads):
            lookup = file.module.index.lookup(uses[0].id, uses[0])
            is_local = lookup is not None and len(lookup[1]) == len(stores)
            is_new = not _is_set_to_start(file, class_, stores)
            if is_local and is_new and _is_state(file, class_, method, uses[0].id):
                yield min(stores, key=lambda name: (name.lineno, name.col_offset))


def _is_set_to_start(file: RclpyFile, class_: NodeClass, stores: list[ast.Name]) -> bool:
    """Return whether variables are set to the initial constant of the attribute."""
    starts = [
        parent.value
        for use in file.module.index.attributes(stores[0].id)
        if file.module.enclosing_class(use) is class_.node
        and isinstance(parent := file.module.parent(use), ast.Assign)
    ]
    given = [
        parent.value for it in stores if isinstance(parent := file.module.parent(it), ast.Assign)
    ]
    texts = {ast.dump(value) for value in (*starts, *given)}
    return len(texts) == 1 and isinstance(given[0], ast.Constant)


def _is_logged(file: RclpyFile, name: ast.Name) -> bool:
    """Return whether a name is only used in a logged or printed text."""
    for parent in file.module.parents(name):
        match parent:
            case ast.Call(func=ast.Attribute(value=ast.Call(func=ast.Attribute(attr=attr)))):
                return attr == "get_logger"
            case ast.Call(func=ast.Name("print")):
                return True
            case ast.Call() | ast.stmt():
                return False
    return False


def _is_state(file: RclpyFile, class_: NodeClass, method: ast.AST, name: str) -> bool:
    """Return whether an attribute is only set by the constructor, and read by other methods."""
    uses = [
        use
        for use in file.module.index.attributes(name)
        if file.module.enclosing_class(use) is class_.node
    ]
    starting = class_.methods.get("__init__")
    stores = [use for use in uses if not isinstance(use.ctx, ast.Load)]
    loads = [use for use in uses if isinstance(use.ctx, ast.Load)]
    if not stores or any(file.function_of(use) is not starting for use in stores):
        return False
    is_plain = all(_is_start(file.module.parent(use)) for use in stores)
    readers = {file.function_of(use) for use in loads}
    return is_plain and bool(readers - {method, starting})


def _is_start(assigned: ast.AST | None) -> bool:
    """Return whether the initial value of an attribute is a constant.

    That of a parameter is configured, and a local variable of its name is another value.
    """
    return isinstance(assigned, ast.Assign) and isinstance(assigned.value, ast.Constant)
