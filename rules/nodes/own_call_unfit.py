"""ND070: own methods are called with the arguments that they take."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Rule
from scaffold.model.call_fit import misfit
from scaffold.model.handlers import is_harmless
from scaffold.model.node_entities import Callback
from scaffold.model.nodes import NodeFacts

_NODE = (
    "from rclpy.node import Node\nfrom std_msgs.msg import String\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "        self.pub = self.create_publisher(String, 'chatter', 10)\n"
    "        self.talk({})\n\n"
    "    def talk(self, text, times=1):\n"
    "        for _ in range(times):\n"
    "            self.pub.publish(String(data=text))\n"
)


class OwnCallUnfit(Rule):
    """A method of the node, or a function of the file, gets other arguments than it takes.

    **Why.** ``TypeError: Talker.talk() missing 1 required positional argument: 'text'`` when the
    line is reached; in a callback that ends the node.

    **Fix.** Give what it takes.

    **Source.** Python documentation, "Function definitions".
    """

    code = "ND070"
    name = "own-call-unfit"
    examples = (
        Example("what it takes", {"talker.py": _NODE.format("'hello', times=2")}),
        Example(
            "of another module",
            {
                "package.xml": "<package><name>talker</name></package>\n",
                "talker/__init__.py": "",
                "talker/text.py": "def make(text, count):\n    return f'{text}: {count}'\n",
                "talker/node.py": "import rclpy\n\nfrom talker.text import make\n\n"
                "rclpy.init()\nprint(make('a', 1))\nprint(make('a'))\n",
            },
            at=("talker/node.py:7",),
        ),
        Example(
            "a constructor",
            {"talker.py": _NODE.format("'a'") + "\n\nTALKER = Talker('talker')\n"},
            at=("talker.py:16",),
        ),
        Example("nothing", {"talker.py": _NODE.format("")}, at=("talker.py:9",)),
        Example("too much", {"talker.py": _NODE.format("'a', 2, 3")}, at=("talker.py:9",)),
        Example("another name", {"talker.py": _NODE.format("txt='a'")}, at=("talker.py:9",)),
        Example(
            "replaced in a class that inherits, or by hand",
            {
                "talker.py": _NODE.format("")
                + "\n\nclass Loud(Talker):\n    def talk(self):\n        pass\n"
            },
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for facts in package.rclpy_files():
            for call in facts.module.walk(ast.Call):
                if not isinstance(call.func, ast.Name | ast.Attribute):
                    continue
                callback = facts.callback(call.func)
                problem = _problem(facts, call, callback)
                if not problem and callback.function is None:
                    problem = _problem_of_imported(package, facts, call) or _problem_of_class(
                        facts, call
                    )
                if problem and not is_harmless(facts.module, call, "TypeError"):
                    name = callback.name or facts.module.text(call.func)
                    message = f"{name}() {problem}: TypeError"
                    yield self.report(facts.module.location(call), message)


def _problem(facts: NodeFacts, call: ast.Call, callback: Callback) -> str:
    """Say what does not fit, if it is known for sure which function is called."""
    function = callback.function
    if function is None or isinstance(function, ast.Lambda) or function.decorator_list:
        return ""
    if callback.is_called or callback.is_partial or not _is_only_one(facts, call.func, function):
        return ""
    if any(isinstance(one, ast.Starred) for one in call.args):
        return ""
    if any(word.arg is None for word in call.keywords):
        return ""
    return misfit(call, function.args, bound=int(callback.is_bound))


def _problem_of_class(facts: NodeFacts, call: ast.Call) -> str:
    """Say what does not fit the constructor of a class of nodes of this file."""
    class_ = facts.evaluator.named_class(call.func)
    node = facts.node_class(class_) if class_ is not None else None
    constructor = node.methods.get("__init__") if node is not None else None
    if constructor is None or constructor.decorator_list or (class_ and class_.decorator_list):
        return ""
    if class_ is None or class_.keywords or any(isinstance(one, ast.Starred) for one in call.args):
        return ""
    if any(word.arg is None for word in call.keywords):
        return ""
    return misfit(call, constructor.args, bound=1)


def _problem_of_imported(package: Package, facts: NodeFacts, call: ast.Call) -> str:
    """Say what does not fit a function that another module of the package defines."""
    dotted = facts.module.qualified_name(call.func) or ""
    module, _, name = dotted.rpartition(".")
    path = f"{module.replace('.', '/')}.py"
    if (
        not module
        or not package.has(path)
        or any(isinstance(one, ast.Starred) for one in call.args)
    ):
        return ""
    other = package.module(path)
    bindings = other.index.bindings(other.tree).get(name, ())
    function = bindings[0].node if len(bindings) == 1 else None
    if not isinstance(function, ast.FunctionDef | ast.AsyncFunctionDef):
        return ""
    if function.decorator_list:
        return ""
    if any(word.arg is None for word in call.keywords):
        return ""
    return misfit(call, function.args, bound=0)


def _is_only_one(
    facts: NodeFacts, func: ast.expr, function: ast.FunctionDef | ast.AsyncFunctionDef
) -> bool:
    """Tell whether no class that inherits, and no assignment, puts another function in place."""
    others = [one for one in facts.module.function_nodes if one.name == function.name]
    if len(others) != 1 or facts.evaluator.stores(function.name):
        return False
    if not isinstance(func, ast.Attribute):
        return True
    class_ = facts.evaluator.self_class(func.value)
    return class_ is not None and function in class_.body
