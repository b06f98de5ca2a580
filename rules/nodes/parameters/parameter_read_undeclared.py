"""ND050: parameters are declared before they are read."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping

from scaffold.api import Diagnostic, Example, Package, RclpyRule, closest_name
from scaffold.api.parameters import declared_alone, has_always
from scaffold.api.python import FunctionNode, is_handled
from scaffold.api.rclpy import (
    NodeClass,
    NodeDefinition,
    Parameter,
    ParameterRead,
    RclpyFile,
    names_used_by,
)

_NODE = (
    "from rclpy.node import Node\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "{}"
    "        self.rate = self.get_parameter('rate').value\n"
    "{}"
)
_DECLARED = "        self.declare_parameter('rate', 1.0)\n"
_LISTED = (
    "        import limits\n"
    "        for name in limits.{}:\n            self.declare_parameter(name, 1.0)\n"
)
_OTHERS = (
    "        names = self.get_parameters(['rate', 'rats'])\n"
    "        self.undeclare_parameter('rates')\n"
)
_LOADING = (
    "from rclpy.node import Node\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n{}"
    "        self.load()\n{}\n"
    "    def load(self):\n"
    "        self.rate = self.get_parameter('rate').value\n"
)


class ParameterReadUndeclared(RclpyRule):
    """A node reads or sets a parameter that it has not declared, or not yet.

    **Why.** ``rclpy.exceptions.ParameterNotDeclaredException`` when the line is executed, which
    ``except KeyError`` does not catch. ``get_parameter_or`` returns its alternative, even if a
    parameter file sets the parameter.

    **Fix.** Call ``self.declare_parameter`` with a default first.

    **Source.** ``rclpy/node.py``, ``get_parameter``; ROS 2 documentation, "About parameters".
    """

    code = "ND050"
    name = "parameter-read-undeclared"
    examples = (
        Example("declared", {"talker.py": _NODE.format(_DECLARED, "")}),
        Example(
            "declared by the caller", {"talker.py": _NODE.format("        declare_all(self)\n", "")}
        ),
        Example(
            "declared through a variable",
            {
                "talker.py": _NODE.format(
                    "        declare = self.declare_parameter\n        declare('rate', 1.0)\n", ""
                )
            },
        ),
        Example(
            "all names in a list of another module, and one more",
            {
                "limits.py": "RATES = ['rate', 'turn_rate']\nGAINS = ['gain', 'rates']\n",
                "a.py": _NODE.format(_LISTED.format("RATES"), ""),
                "b.py": _NODE.format(_LISTED.format("GAINS"), ""),
            },
            "b.py:10:21: parameter 'rate' is not declared: ParameterNotDeclaredException; did you "
            "mean 'rates'?",
        ),
        Example(
            "all in a table for declare_parameters, and another one",
            {
                "package.xml": "<package><name>demo</name></package>\n",
                "demo/tables.py": "RATES = (('rate', 1.0), ('gain', 2))\nGAINS = [('gain', 2)]\n",
                **{
                    f"demo/{name.lower()}.py": "from demo.tables import GAINS, RATES\n"
                    + _NODE.format(f"        self.declare_parameters('', {name})\n", "")
                    for name in ("RATES", "GAINS")
                },
            },
            "demo/gains.py:9:21: parameter 'rate' is not declared: ParameterNotDeclaredException",
        ),
        Example(
            "a table that a derived class replaces, and one that it does not",
            {
                "package.xml": "<package><name>demo</name></package>\n",
                **{
                    f"demo/{name}.py": _NODE.format(
                        "        self.declare_parameters('', self.TABLE)\n", ""
                    ).replace("    def", "    TABLE = (('rate', 1.0),)\n\n    def", 1)
                    + "        self.gain = 1.0\n\n\nclass Other(Talker):\n"
                    + table
                    + "\n    def read(self):\n        return self.get_parameter('rats')\n"
                    for name, table in (
                        ("same", "    pass\n"),
                        ("own", "    TABLE = (('rats', 1.0),)\n"),
                    )
                },
            },
            "demo/same.py:18:16: parameter 'rats' is not declared: ParameterNotDeclaredException; "
            "did you mean 'rate'?",
        ),
        Example(
            "all in a table of the class, and another one",
            {
                f"{name}.py": _NODE.format(
                    "        for name, default in self.DEFAULTS.items():\n"
                    f"            self.declare_parameter(name, default)\n{more}",
                    "",
                ).replace("    def", f"    DEFAULTS = {{'{name}': 1.0, 'gain': 0.5}}\n\n    def", 1)
                for name, more in {
                    "rate": "",
                    "rates": "",
                    "turn_rate": "        self.DEFAULTS['other'] = 2.0\n",
                }.items()
            },
            "rates.py:11:21: parameter 'rate' is not declared: ParameterNotDeclaredException; did "
            "you mean 'rates'?",
        ),
        Example(
            "another parameter declared",
            {"talker.py": _NODE.format(_DECLARED.replace("rate", "rates"), "")},
            "8:21: parameter 'rate' is not declared: ParameterNotDeclaredException; did you mean "
            "'rates'?",
        ),
        Example(
            "undeclared names in a list",
            {"talker.py": _NODE.format(_DECLARED, _OTHERS)},
            "9:46: parameter 'rats' is not declared: ParameterNotDeclaredException; did you mean "
            "'rate'?",
            "10:34: parameter 'rates' is not declared: ParameterNotDeclaredException; did you "
            "mean 'rate'?",
        ),
        Example(
            "names passed to a method that reads them",
            {
                "talker.py": _NODE.format(_DECLARED, "        self.turn = self.read('turn')\n")
                + "\n    def read(self, name):\n"
                "        try:\n"
                "            return self.get_parameter(name).value\n"
                "        except KeyError:\n"
                "            return 0.0\n"
            },
            "9:31: parameter 'turn' is not declared: ParameterNotDeclaredException",
        ),
        Example(
            "an undeclared parameter with an alternative",
            {
                "talker.py": _NODE.format(
                    _DECLARED,
                    "        default = Parameter('gain', Parameter.Type.DOUBLE, 1.0)\n"
                    "        self.gain = self.get_parameter_or('gain', default).value\n"
                    "        self.other = self.get_parameter_or('rate', default).value\n",
                ).replace(
                    "node import Node", "node import Node\nfrom rclpy.parameter import Parameter"
                )
            },
            "11:21: parameter 'gain' is never declared: any value set for it is ignored",
        ),
        Example(
            "declared after the call of a method that reads it",
            {
                "talker.py": _LOADING.format("", _DECLARED),
                "first.py": _LOADING.format(_DECLARED, ""),
                "both.py": _LOADING.format("        self.declare()\n", "        self.declare()\n")
                + "\n    def declare(self):\n"
                + _DECLARED,
            },
            "talker.py:11:21: load() reads parameter 'rate' in line 7, before it is declared in "
            "line 8: ParameterNotDeclaredException",
        ),
        Example(
            "declared too late",
            {"talker.py": _NODE.format("", _DECLARED)},
            "7:21: parameter 'rate' is read before it is declared in line 8: "
            "ParameterNotDeclaredException",
        ),
    )

    def check_in(self, package: Package, file: RclpyFile) -> Iterator[Diagnostic]:
        for node, declared in declared_alone(file):
            by_name: dict[str, list[Parameter]] = {}
            for parameter in declared:
                by_name.setdefault(str(parameter.name), []).append(parameter)
            for read in node.parameter_reads:
                message = _message(package, read, by_name) or _called_early(node, read, by_name)
                if message and not is_handled(
                    node.file.module, read.call, "ParameterNotDeclaredException"
                ):
                    yield self.report(read, message)
            for used in names_used_by(package, node):
                if used.name in by_name or has_always(used.name):
                    continue
                module = node.file.module
                if not is_handled(module, used.call, "ParameterNotDeclaredException"):
                    yield self.report(
                        module.location(used.node), _undeclared(package, used.name, by_name)
                    )


def _message(package: Package, read: ParameterRead, declared: dict[str, list[Parameter]]) -> str:
    if not isinstance(read.name, str) or has_always(read.name):
        return ""
    same = declared.get(read.name, [])
    if read.method == "get_parameter_or" and not same:
        return f"parameter {read.name!r} is never declared: any value set for it is ignored"
    if read.method != "get_parameter":
        return ""
    if not same:
        return _undeclared(package, read.name, declared)
    late = [
        other.location.line
        for other in same
        if other.function is read.function and other.location.line > read.location.line
    ]
    if len(late) == len(same) and not read.is_conditional:
        return (
            f"parameter {read.name!r} is read before it is declared in line {late[0]}: "
            "ParameterNotDeclaredException"
        )
    return ""


def _called_early(
    node: NodeDefinition, read: ParameterRead, declared: Mapping[str, list[Parameter]]
) -> str:
    """Return the problem with a parameter read in a method that the constructor calls early."""
    same = declared.get(str(read.name), [])
    if not isinstance(node, NodeClass) or not same or read.method != "get_parameter":
        return ""
    reading, *_ = [*_places(node, read.function, is_certain=True), 0]
    declaring = [
        [other.location.line]
        if other.function is node.constructor
        else [*_places(node, other.function, is_certain=False)]
        for other in same
    ]
    if not reading or read.is_conditional or not all(declaring):
        return ""
    line = min(map(min, declaring))
    if line <= reading or read.function is None:
        return ""
    return (
        f"{read.function.name}() reads parameter {read.name!r} in line {reading}, before it is "
        f"declared in line {line}: ParameterNotDeclaredException"
    )


def _places(node: NodeClass, method: FunctionNode | None, *, is_certain: bool) -> Iterator[int]:
    """Yield the lines of the constructor that call a method.

    Args:
        node: The class.
        method: The method.
        is_certain: Whether only unconditional calls count.
    """
    file = node.file
    if node.constructor is None or method is None or node.methods.get(method.name) is not method:
        return
    for call in file.calls_in(node.constructor):
        match call.func:
            case ast.Attribute(value=ast.Name(id="self"), attr=name) if name == method.name:
                if not (is_certain and file.is_conditional(call)):
                    yield call.lineno


def _undeclared(package: Package, name: str, declared: dict[str, list[Parameter]]) -> str:
    closest = closest_name(package, name, declared, 0.7)
    hint = f"; did you mean {closest!r}?" if closest else ""
    return f"parameter {name!r} is not declared: ParameterNotDeclaredException{hint}"
