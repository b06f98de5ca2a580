"""ND001: node classes inherit from Node, and first call its constructor with a name."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Effect, Example, Package, RclpyRule, Report, Severity, fact
from scaffold.api.install import file_of
from scaffold.api.rclpy import NODE, NodeClass, RclpyFile, defined_by, has, names_of_bases

_NODE = (
    "from rclpy.node import Node\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        {}\n"
    "        self.create_timer(1.0, print)\n"
)
_MISSPELLED = frozenset({"_init_", "__init", "_init__", "__init_", "init", "__int__", "__intit__"})
_NODE_CONSTRUCTOR = (
    "from rclpy.node import Node\n\n\n"
    "class Talker(Node):\n"
    "    def {}(self):\n"
    "{}"
    "        self.create_timer(1.0, print)\n"
)
_INIT = "        super().__init__('talker')\n"
_CREATES = ("create_publisher", "create_subscription", "create_timer", "declare_parameter")
_NODE_BASE = (
    "from rclpy.node import Node\n\n\n"
    "class Talker{}:\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "        self.create_timer(1.0, print)\n"
)


class NodeNotConstructed(RclpyRule):
    """A node class does not inherit from Node, or does not first call its constructor with a name.

    **Why.** ``TypeError: Node.__init__() missing 1 required positional argument: 'node_name'``, or
    ``AttributeError`` at the first use of the node: ``'Talker' object has no attribute
    '_Node__...'``, or ``'create_timer'`` without the base class.

    **Fix.** Write ``class Talker(Node):``, and start ``def __init__(self):`` with
    ``super().__init__('talker')``.

    **Source.** ``rclpy/node.py``, ``Node.__init__``; ROS 2 documentation, "Writing a simple
    publisher and subscriber (Python)".
    """

    code = "ND001"
    name = "node-not-constructed"
    effect = Effect.STOPS_START
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
            "not called",
            {"talker.py": _NODE.format("self.count = 0")},
            "5:9: Talker.__init__() does not call super().__init__(): AttributeError",
        ),
        Example(
            "a class that is never used as a node",
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
            "super() with the class Node",
            {"talker.py": _NODE.format("super(Node, self).__init__('talker')")},
            "6:9: this super() skips the constructor of Node; write super()",
        ),
        Example(
            "an unbound super",
            {"talker.py": _NODE.format("super(Talker).__init__('talker')")},
            "6:9: super() with only a class is unbound; write super()",
        ),
        Example(
            "self twice",
            {"talker.py": _NODE.format("super().__init__(self, 'talker')")},
            "6:9: super() already passes self; the first argument is the node name",
        ),
        Example(
            "called without a name",
            {"talker.py": _NODE_CONSTRUCTOR.format("__init__", _INIT.replace("'talker'", ""))},
            "6:9: Node.__init__() is called without a node name: TypeError",
        ),
        Example(
            "super without parentheses",
            {"talker.py": _NODE_CONSTRUCTOR.format("__init__", _INIT.replace("super()", "super"))},
            "6:9: 'super' is not called: TypeError; write super().__init__(...)",
        ),
        Example(
            "called too late",
            {"talker.py": _NODE_CONSTRUCTOR.format("__init__", "") + _INIT},
            "6:9: self.create_timer is used before Node.__init__() in line 7: AttributeError",
        ),
        Example(
            "__init__ misspelled",
            {"talker.py": _NODE_CONSTRUCTOR.format("_init_", _INIT)},
            "5:9: '_init_' is never called as a constructor; did you mean '__init__'?",
        ),
        Example(
            "__init__ without self",
            {"talker.py": _NODE_CONSTRUCTOR.format("__init__", _INIT.replace("super()", "Node"))},
            "6:9: Node.__init__() is called without self: TypeError; write super().__init__(...)",
        ),
        Example(
            "two constructors with one underscore",
            {"talker.py": _NODE_CONSTRUCTOR.format("_init_", _INIT.replace("__init__", "_init_"))},
            "5:9: '_init_' is never called as a constructor; did you mean '__init__'?",
        ),
        Example(
            "a mixin for nodes",
            {"talker.py": _NODE_BASE.format("") + "\n\nclass Both(Node, Talker):\n    pass\n"},
        ),
        Example(
            "an abstract node",
            {
                "talker.py": "from rclpy.node import Node\n\n\nclass Talker(Node):\n"
                "    def __init__(self):\n        pass\n"
            },
            Report(
                "5:9",
                "Talker.__init__() does not call super().__init__(): AttributeError as soon as it "
                "is used as a node",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "a mixin for the nodes of another module",
            {
                "moving.py": _NODE_BASE.format("").replace("Talker", "Moving"),
                "arm.py": "from moving import Moving\nfrom rclpy.node import Node\n\n\n"
                "class Arm(Node, Moving):\n    pass\n",
            },
        ),
        Example(
            "a mixin for nodes of other packages",
            {"talker.py": _NODE_BASE.format("").replace("'talker'", "")},
        ),
        Example(
            "a node without a base class",
            {"talker.py": _NODE_BASE.format("")},
            "4:7: 'Talker' uses methods of Node, but does not inherit from it: AttributeError; "
            "inherit from Node",
        ),
        Example(
            "object as base class",
            {"talker.py": _NODE_BASE.format("(object)")},
            "4:7: 'Talker' uses methods of Node, but does not inherit from it: AttributeError; "
            "inherit from Node",
        ),
        Example(
            "base classes before Node, with and without super()",
            {
                "package.xml": "<package><name>rover</name></package>\n",
                "rover/__init__.py": "",
                "rover/parts.py": "class Remembering:\n    def __init__(self):\n"
                "        self.said = []\n\n\n"
                "class Counting:\n    def __init__(self, *args):\n"
                "        super().__init__(*args)\n        self.count = 0\n",
                "rover/nodes.py": "from rclpy.node import Node\n"
                "from rover.parts import Counting, Remembering\n\n\n"
                "class Speaker(Remembering, Node):\n    def __init__(self):\n"
                "        super().__init__()\n        self.create_timer(1.0, print)\n\n\n"
                "class Counter(Counting, Node):\n    def __init__(self):\n"
                "        super().__init__('counter')\n        self.create_timer(1.0, print)\n",
            },
            "rover/nodes.py:7:9: Remembering.__init__() comes first, but does not call "
            "super().__init__(): Node is not initialized",
        ),
    )

    def check_in(self, package: Package, file: RclpyFile) -> Iterator[Diagnostic]:
        yield from self._check_call(package, file)
        yield from self._check_constructor(file)
        yield from self._check_base(package, file)

    def _check_call(self, package: Package, file: RclpyFile) -> Iterator[Diagnostic]:
        for node in file.classes:
            skipped = _skipping(file, node)
            if skipped is not None:
                yield self.report(file.module.location(skipped[0]), skipped[1])
                continue
            ending = _ending(package, file, node)
            if ending is not None:
                message = (
                    f"{ending[1]}.__init__() comes first, but does not call super().__init__(): "
                )
                message += "Node is not initialized"
                yield self.report(file.module.location(ending[0]), message)
            if node.calls_super_init or node.constructor is None or node.is_made_later:
                continue
            at = file.module.name_location(node.constructor)
            message = f"{node.name}.__init__() does not call super().__init__(): AttributeError"
            if not _is_used_as_node(file, node) or _is_outline(package, file, node):
                message += " as soon as it is used as a node"
                yield self.report(at, message, severity=Severity.WARNING)
                continue
            yield self.report(at, message)

    def _check_constructor(self, file: RclpyFile) -> Iterator[Diagnostic]:
        for node in file.classes:
            yield from self._check(file, node)

    def _check(self, file: RclpyFile, node: NodeClass) -> Iterator[Diagnostic]:
        for name, method in node.methods.items():
            if name in _MISSPELLED and node.constructor is None and _calls_init(method):
                message = f"{name!r} is never called as a constructor; did you mean '__init__'?"
                yield self.report(file.module.name_location(method), message)
        call = node.super_init
        if call is None or node.base is not None or not isinstance(call.func, ast.Attribute):
            return
        at, value = file.module.location(call), call.func.value
        is_call = isinstance(value, ast.Call)
        if isinstance(value, ast.Name) and value.id == "super":
            yield self.report(at, "'super' is not called: TypeError; write super().__init__(...)")
        elif not is_call and file.is_node_class(value) and _is_text(call.args[:1]):
            yield self.report(
                at, "Node.__init__() is called without self: TypeError; write super().__init__(...)"
            )
        elif is_call and not call.args and not call.keywords and len(node.node.bases) == 1:
            yield self.report(at, "Node.__init__() is called without a node name: TypeError")
        for used in _used_before(file, node, call):
            message = f"self.{used.attr} is used before Node.__init__() in line {at.line}"
            yield self.report(file.module.location(used), f"{message}: AttributeError")

    def _check_base(self, package: Package, file: RclpyFile) -> Iterator[Diagnostic]:
        for class_ in file.module.classes.values():
            if _lacks_base(file, class_.node) and class_.name not in names_of_bases(package):
                message = (
                    f"{class_.name!r} uses methods of Node, but does not inherit from it: "
                    f"AttributeError; inherit from Node"
                )
                cause = f"base of {class_.name} in {file.module.path}"  # as in TY003
                yield self.report(class_, message, cause=cause)


def _skipping(file: RclpyFile, node: NodeClass) -> tuple[ast.Call, str] | None:
    """Return a use of ``super`` that does not call the constructor of Node, and the reason."""
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


def _ending(package: Package, file: RclpyFile, node: NodeClass) -> tuple[ast.Call, str] | None:
    """Return the call of ``super().__init__`` that another base class answers, and its name."""
    call = node.super_init
    if call is None or not isinstance(call.func, ast.Attribute) or not _is_super(call.func.value):
        return None
    calls = (
        [item for item in file.calls_in(node.constructor) if _is_init(item)]
        if node.constructor
        else []
    )
    for base in node.node.bases[: node.base_index] if calls == [call] else ():
        module, _, name = (file.module.qualified_name(base) or ast.unparse(base)).rpartition(".")
        is_own = bool(module) and file.is_own_module(module)
        path = file_of(package, module) if is_own else "" if module else file.module.path
        ends = _ends_chain(package, path, name) if path else None
        if ends is None:
            return None
        if ends:
            return call, name
    return None


def _is_init(call: ast.Call) -> bool:
    return isinstance(call.func, ast.Attribute) and call.func.attr == "__init__"


@fact
def _ends_chain(package: Package, path: str, name: str) -> bool | None:
    """Return whether the constructor of a class calls no other; ``None`` if that is not known."""
    classes = [item for item in package.module(path).walk(ast.ClassDef) if item.name == name]
    if len(classes) != 1 or classes[0].bases or classes[0].decorator_list:
        return None
    methods = [item for item in classes[0].body if isinstance(item, ast.FunctionDef)]
    constructors = [item for item in methods if item.name == "__init__"]
    if not constructors:
        return False
    return not any(
        (isinstance(node, ast.Name) and node.id == "super")
        or (isinstance(node, ast.Attribute) and node.attr == "__init__")
        for node in ast.walk(constructors[0])
    )


def _is_outline(package: Package, file: RclpyFile, node: NodeClass) -> bool:
    """Return whether a constructor is still empty and its class unused."""
    body = node.constructor.body if node.constructor is not None else []
    if not all(isinstance(item, ast.Pass | ast.Expr) for item in body):
        return False
    if any(isinstance(call, ast.Call) for item in body for call in ast.walk(item)):
        return False
    modules = package.modules(mentioning=(node.name,))
    return not any(
        other.path != file.module.path or other.index.names(node.name) for other in modules
    )


def _is_used_as_node(file: RclpyFile, node: NodeClass) -> bool:
    """Return whether an object of a class is used as a node, or passed on."""
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


def _is_text(nodes: list[ast.expr]) -> bool:
    return any(isinstance(node, ast.Constant) and isinstance(node.value, str) for node in nodes)


def _calls_init(method: ast.AST) -> bool:
    return any(
        isinstance(node, ast.Attribute)
        and (node.attr == "__init__" or (node.attr in _MISSPELLED and _is_super(node.value)))
        for node in ast.walk(method)
    )


def _is_super(node: ast.expr) -> bool:
    return (
        isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id == "super"
    )


def _used_before(file: RclpyFile, node: NodeClass, call: ast.Call) -> list[ast.Attribute]:
    """Return the first method of Node that the constructor calls before Node's constructor."""
    own = set(file.module.index.bindings(node.node))
    for other in file.calls_in(node.constructor) if node.constructor else ():
        func = other.func
        if other.lineno < call.lineno and isinstance(func, ast.Attribute) and func.attr not in own:
            is_self = file.evaluator.self_class(func.value) is node.node
            if is_self and has(NODE, func.attr) and not file.is_conditional(call):
                return [func]
    return []


def _lacks_base(file: RclpyFile, class_: ast.ClassDef) -> bool:
    """Return whether a class without bases treats itself as a node."""
    bases = [base.id if isinstance(base, ast.Name) else "?" for base in class_.bases]
    if [base for base in bases if base != "object"] or class_.keywords or class_.decorator_list:
        return False
    text = file.module.source.text
    if class_.name in {base for other in file.module.walk(ast.ClassDef) for base in _bases(other)}:
        return False
    if _hands_on(file, class_):
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


def _hands_on(file: RclpyFile, class_: ast.ClassDef) -> bool:
    """Return whether a class without bases calls ``super().__init__`` like a mixin."""
    for call in file.module.below(class_, ast.Call):
        match call:
            case ast.Call(
                func=ast.Attribute(value=ast.Call(func=ast.Name("super")), attr="__init__"),
                args=[],
                keywords=[],
            ):
                return True
    return False


def _bases(class_: ast.ClassDef) -> list[str]:
    return [base.id for base in class_.bases if isinstance(base, ast.Name)]
