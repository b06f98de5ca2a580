"""ND016: parameters are declared once."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Effect, Example, Package, RclpyRule, Report, Severity
from scaffold.api.parameters import parameter_files
from scaffold.api.python import is_handled
from scaffold.api.rclpy import NodeDefinition, Parameter, RclpyFile

_NODE = (
    "from rclpy.node import Node\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "        self.declare_parameter('rate', 2.0)\n"
    "        self.declare_parameter('{}', 1.0)\n"
)


class ParameterRepeated(RclpyRule):
    """A node declares a parameter twice, or one that rclpy declares itself.

    rclpy declares ``use_sim_time`` and, with ``automatically_declare_parameters_from_overrides``,
    each parameter that a file, a launch file or the command line sets.

    **Why.** ``rclpy.exceptions.ParameterAlreadyDeclaredException`` at start.

    **Fix.** Remove the second declaration, and that of ``use_sim_time``.

    **Source.** ``rclpy/node.py``, ``declare_parameters``; ``rclpy/time_source.py``.
    """

    code = "ND016"
    name = "parameter-repeated"
    effect = Effect.STOPS_START
    other_severities = {
        Severity.WARNING: "rclpy only declares parameters that are set, and no file of the "
        "package sets it"
    }
    examples = (
        Example("two parameters", {"talker.py": _NODE.format("period")}),
        Example(
            "one parameter twice",
            {"talker.py": _NODE.format("rate")},
            "8:32: parameter 'rate' is already declared in line 7: "
            "ParameterAlreadyDeclaredException",
        ),
        Example(
            "a parameter of every node",
            {"talker.py": _NODE.format("use_sim_time")},
            "8:32: 'use_sim_time' is already declared by rclpy: ParameterAlreadyDeclaredException",
        ),
        Example(
            "if the exception is caught",
            {
                "talker.py": _NODE.format("use_sim_time").replace(
                    "        self.declare_parameter('use_sim_time', 1.0)\n",
                    "        try:\n"
                    "            self.declare_parameter('use_sim_time', True)\n"
                    "        except ParameterAlreadyDeclaredException:\n"
                    "            pass\n",
                )
            },
        ),
        Example(
            "declared automatically, and set",
            {
                "talker.py": _NODE.format("period").replace(
                    "'talker'", "'talker', automatically_declare_parameters_from_overrides=True"
                ),
                "config/a.yaml": "talker:\n  ros__parameters:\n    rate: 3.0\n",
            },
            "talker.py:7:32: parameter 'rate' is declared automatically when config/a.yaml sets "
            "it: ParameterAlreadyDeclaredException; check has_parameter() first",
            Report(
                "talker.py:8:32",
                "parameter 'period' is declared automatically when it is set: "
                "ParameterAlreadyDeclaredException; check has_parameter() first",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "options that may be set, or that only allow undeclared parameters",
            {
                "talker.py": _NODE.format("period").replace("'talker'", "'talker', **options"),
                "listener.py": _NODE.format("period").replace(
                    "'talker'", "'listener', allow_undeclared_parameters=True"
                ),
                "config/a.yaml": "/**:\n  ros__parameters:\n    rate: 3.0\n",
            },
        ),
        Example(
            "tested first",
            {
                "talker.py": _NODE.format("period")
                .replace(
                    "'talker'", "'talker', automatically_declare_parameters_from_overrides=True"
                )
                .replace(
                    "        self.d", "        if not self.has_parameter('x'):\n            self.d"
                )
            },
        ),
    )

    def check_in(self, package: Package, file: RclpyFile) -> Iterator[Diagnostic]:
        for parameter in file.parameters:
            if parameter.name != "use_sim_time" or parameter.owner is None:
                continue
            if _always_fails(file, parameter):
                message = "'use_sim_time' is already declared by rclpy: "
                message += "ParameterAlreadyDeclaredException"
                yield self.report(parameter.name_location, message)
        for node in file.nodes:
            yield from self._automatic(package, node)
            first: dict[str, int] = {}
            for parameter in node.parameters:
                name = parameter.name
                if not isinstance(name, str) or parameter.is_conditional:
                    continue
                at = parameter.name_location
                if name in first and _always_fails(file, parameter):
                    message = (
                        f"parameter {name!r} is already declared in line {first[name]}: "
                        "ParameterAlreadyDeclaredException"
                    )
                    yield self.report(at, message)
                first.setdefault(name, at.line)

    def _automatic(self, package: Package, node: NodeDefinition) -> Iterator[Diagnostic]:
        """Report parameters that a node declares although rclpy already has, if they are set."""
        if not node.is_declared_by_overrides or "has_parameter" in node.file.module.source.text:
            return
        for parameter in node.parameters:
            name = parameter.name
            if not isinstance(name, str) or not _always_fails(node.file, parameter):
                continue
            path = _set_in(package, name)
            where = f"{path} sets it" if path else "it is set"
            message = (
                f"parameter {name!r} is declared automatically when {where}: "
                "ParameterAlreadyDeclaredException; check has_parameter() first"
            )
            severity = None if path else Severity.WARNING
            yield self.report(parameter.name_location, message, severity=severity)


def _always_fails(file: RclpyFile, parameter: Parameter) -> bool:
    """Return whether a second declaration of a parameter ends the node."""
    error = "ParameterAlreadyDeclaredException"
    return not (parameter.is_conditional or is_handled(file.module, parameter.call, error))


def _set_in(package: Package, name: str) -> str:
    """Return the parameter file of a package that sets a parameter; empty if there is none."""
    for file in parameter_files(package):
        for section in file.sections:
            if any(entry.name == name for entry in section.entries):
                return file.path
    return ""
