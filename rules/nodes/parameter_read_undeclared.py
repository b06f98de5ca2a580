"""ND050: parameters are declared before they are read."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, RclpyRule, closest_name
from scaffold.api.parameters import declared_alone, has_always
from scaffold.api.python import is_handled
from scaffold.api.rclpy import Parameter, ParameterRead, RclpyFile, names_used_by

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


class ParameterReadUndeclared(RclpyRule):
    """A node reads or sets a parameter that it has not declared, or not yet.

    **Why.** ``rclpy.exceptions.ParameterNotDeclaredException`` when the line is reached.

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
            "all in a list of another module, and another one",
            {
                "limits.py": "RATES = ['rate', 'turn_rate']\nGAINS = ['gain', 'rates']\n",
                "a.py": _NODE.format(_LISTED.format("RATES"), ""),
                "b.py": _NODE.format(_LISTED.format("GAINS"), ""),
            },
            "b.py:10:21: parameter 'rate' is not declared: ParameterNotDeclaredException; did you "
            "mean 'rates'?",
        ),
        Example(
            "another parameter declared",
            {"talker.py": _NODE.format(_DECLARED.replace("rate", "rates"), "")},
            "8:21: parameter 'rate' is not declared: ParameterNotDeclaredException; did you mean "
            "'rates'?",
        ),
        Example(
            "read in a list, undeclared",
            {"talker.py": _NODE.format(_DECLARED, _OTHERS)},
            "9:46: parameter 'rats' is not declared: ParameterNotDeclaredException; did you mean "
            "'rate'?",
            "10:34: parameter 'rates' is not declared: ParameterNotDeclaredException; did you "
            "mean 'rate'?",
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
                message = _message(package, read, by_name)
                if message and not is_handled(
                    node.facts.module, read.call, "ParameterNotDeclaredException"
                ):
                    yield self.report(read, message)
            for used in names_used_by(package, node):
                if used.name in by_name or has_always(used.name):
                    continue
                module = node.facts.module
                if not is_handled(module, used.call, "ParameterNotDeclaredException"):
                    yield self.report(
                        module.location(used.node), _undeclared(package, used.name, by_name)
                    )


def _message(package: Package, read: ParameterRead, declared: dict[str, list[Parameter]]) -> str:
    if read.method != "get_parameter" or not isinstance(read.name, str):
        return ""
    if has_always(read.name):
        return ""
    same = declared.get(read.name, [])
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


def _undeclared(package: Package, name: str, declared: dict[str, list[Parameter]]) -> str:
    closest = closest_name(package, name, declared, 0.7)
    hint = f"; did you mean {closest!r}?" if closest else ""
    return f"parameter {name!r} is not declared: ParameterNotDeclaredException{hint}"
