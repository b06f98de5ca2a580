"""PF007: rcl accepts the values of parameter files."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator

from scaffold.api import Diagnostic, Edit, Example, Fix, Package, Report, Rule, Severity
from scaffold.api.formats import Scalar, Sequence
from scaffold.api.launch import is_only_loaded, nodes_for, use_of
from scaffold.api.parameters import (
    ParameterFile,
    declared_by,
    mixed,
    parameter_files,
    place_of,
    scalar_type,
)
from scaffold.api.python import conditions_on, is_handled, values_asked
from scaffold.api.rclpy import NodeClass, NodeDefinition, ParameterRead

from ._started_programs import is_of_nav2

_FILE = "talker:\n  ros__parameters:\n    rate: {}\n"
_FILE_LISTS = "talker:\n  ros__parameters:\n    gains: {}\n"
_NODE = (
    "from rclpy.node import Node\n\n\n"
    "class Talker(Node):\n    def __init__(self):\n        super().__init__('talker')\n"
    "        self.declare_parameter('names', ['a'])\n"
    "        self.names = self.{}.value\n"
)
_FILE_EMPTY = "talker:\n  ros__parameters:\n    names: {}\n"
_ASKING = frozenset({"NOT_SET", "get_parameter_or", "has_parameter", "type_"})
"""Methods and attributes that tell whether a parameter has a value."""
_REWRITTEN = re.compile("^'[^']*' (?:has no value|is the alias)")
"""Matches what RewrittenYaml of Nav2 replaces with a value."""
_SERVERS = frozenset({"amcl", "controller_server", "local_costmap", "map_server"})
"""Nodes of Nav2, whose parameter files have a section for them."""


class ValueRefused(Rule):
    """A parameter file is valid YAML, but contains a value or a list that rcl rejects.

    **Why.** The node does not start: ``RCLError: failed to initialize rcl: Couldn't parse params
    file ... No value at line 3``, ``Will not support aliasing``, ``Sequence should be of same
    type``, ``Sequences cannot be key``, ``There are no node names before ros__parameters``. A
    parameter with an empty list counts as unset, even if it has a default:
    ``ParameterUninitializedException``.

    **Fix.** Write every value out, without aliases; flatten lists of lists; write ``1.0`` among
    doubles, and quote words that YAML reads as another type. Remove an empty list, or write
    ``['']`` and have the node skip empty names.

    **Source.** ``rcl_yaml_param_parser/src/parse.c``; ``rclpy/node.py``, ``get_parameter``.
    """

    code = "PF007"
    name = "value-refused"
    other_severities = {
        Severity.WARNING: "only Nav2 reads the file, which writes a copy with other values"
    }
    examples = (
        Example(
            "values, and a list in a list, which is read as that list",
            {
                "a.yaml": _FILE.format("[1.0, 2.0]"),
                "b.yaml": _FILE.format("''"),
                "c.yaml": _FILE.format("[[-1.48, 1.48]]"),
            },
        ),
        Example(
            "no value; an alias; nested lists",
            {
                "a.yaml": _FILE.format(""),
                "b.yaml": _FILE.format("&rate 2.0\n    more: *rate"),
                "c.yaml": _FILE.format("[[1.0, 2.0], [3.0]]"),
                "d.yaml": _FILE.format("[1.0, [2.0, 3.0]]"),
            },
            "a.yaml:3:5: 'rate' has no value: rcl rejects the file; write '' for an empty string",
            "b.yaml:4:11: 'more' is the alias *rate: rcl rejects the file; write the value",
            "c.yaml:3:12: 'rate' is a list of lists: rcl rejects the file; flatten it",
            "d.yaml:3:17: 'rate' mixes values and a list: rcl reads only some of them; flatten it",
        ),
        Example(
            "no value in a file for Nav2, which writes a copy of it, with null",
            {
                "nav2.yaml": _FILE.format("").replace("talker", "amcl"),
                "launch/nav2.launch.xml": '<include file="$(find-pkg-share nav2_bringup)/launch/'
                'bringup_launch.py"/>\n',
            },
            Report(
                "nav2.yaml:3:5",
                "'rate' has no value: rcl rejects the file; write '' for an empty string",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "no node name; no parameters",
            {
                "a.yaml": "ros__parameters:\n  rate: 2.0\n",
                "b.yaml": "talker:\n  ros__parameters:\n",
            },
            "a.yaml:1:1: no node name above 'ros__parameters': rcl rejects the file",
            "b.yaml:2:3: no parameters under 'ros__parameters': rcl rejects the file",
        ),
        Example("items of the same type", {"config/a.yaml": _FILE_LISTS.format("[1.0, 2.5]")}),
        Example(
            "integers among doubles",
            {"config/a.yaml": _FILE_LISTS.format("[1, 2.5, -3]")},
            Report(
                "3:16",
                "list 'gains' mixes integer (1) and double (2.5): rcl rejects the "
                "file; use one type",
                fix="Convert all values to doubles",
            ),
            fixed={"config/a.yaml": _FILE_LISTS.format("[1.0, 2.5, -3.0]")},
        ),
        Example(
            "a word that YAML reads as a boolean",
            {"config/a.yaml": _FILE_LISTS.format("[left, right, off]")},
            "3:26: list 'gains' mixes string (left) and bool (off): rcl rejects the file; use one "
            "type",
        ),
        Example(
            "a list with items",
            {
                "talker.py": _NODE.format("get_parameter('names')"),
                "a.yaml": _FILE_EMPTY.format("[b]"),
            },
        ),
        Example(
            "a list with several types in a file that only other code reads",
            {
                "launch/a.launch.py": "import yaml\n\n"
                "settings = yaml.safe_load(open('config/a.yaml'))\n",
                "config/a.yaml": _FILE_LISTS.format("[1, 0.5]"),
            },
        ),
        Example(
            "an empty list, and a node that handles it",
            {
                "talker.py": _NODE.format("get_parameter_or('names')"),
                "a.yaml": _FILE_EMPTY.format("[]"),
            },
        ),
        Example(
            "an empty list, and a node that asks whether it is set",
            {
                "talker.py": _NODE.replace(
                    "        self.names",
                    "        kind = self.get_parameter_or('names').type_\n"
                    "        if kind == Parameter.Type.NOT_SET:\n            return\n"
                    "        self.names",
                ).format("get_parameter('names')"),
                "a.yaml": _FILE_EMPTY.format("[]"),
            },
        ),
        Example(
            "an empty list",
            {
                "talker.py": _NODE.format("get_parameter('names')"),
                "a.yaml": _FILE_EMPTY.format("[]"),
            },
            "a.yaml:3:12: an empty list leaves 'names' unset, but talker.py:8 reads it: "
            "ParameterUninitializedException",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for file in parameter_files(package):
            findings = [*self._check_values(package, file), *self._check_lists(file)]
            if findings and not is_only_loaded(package, file.path):
                yield from findings
        yield from self._check_empty(package)

    def _check_values(self, package: Package, file: ParameterFile) -> Iterator[Diagnostic]:
        for refused in file.refused:
            # Nav2 reads the file as YAML and writes a copy, with null for a missing value.
            is_rewritten = bool(_REWRITTEN.search(refused.message)) and _is_of_nav2(package, file)
            severity = Severity.WARNING if is_rewritten else None
            yield self.report(refused.location, refused.message, severity=severity)

    def _check_lists(self, file: ParameterFile) -> Iterator[Diagnostic]:
        for section in file.sections:
            for entry in section.entries:
                mixture = mixed(entry.value)
                if mixture is None or not isinstance(entry.value, Sequence):
                    continue
                first, kind, other, other_kind = mixture
                message = (
                    f"list {entry.name!r} mixes {kind} ({first.text}) and {other_kind} "
                    f"({other.text}): rcl rejects the file; use one type"
                )
                yield self.report(other, message, self._fix(file.path, entry.value))

    def _fix(self, path: str, value: Sequence) -> Fix | None:
        scalars = [item for item in value.items if isinstance(item, Scalar)]
        kinds = [scalar_type(item) for item in scalars]
        if set(kinds) != {"integer", "double"}:
            return None
        whole = [item for item, kind in zip(scalars, kinds, strict=True) if kind == "integer"]
        if not all(item.text.lstrip("+-").isdecimal() for item in whole):
            return None
        edits = tuple(Edit(path, item.end, item.end, ".0") for item in whole)
        return Fix("Convert all values to doubles", edits)

    def _check_empty(self, package: Package) -> Iterator[Diagnostic]:
        for file in parameter_files(package):
            for section in file.sections:
                for entry in section.entries:
                    if not isinstance(entry.value, Sequence) or entry.value.items:
                        continue
                    for owner in nodes_for(package, file.path, section):
                        read = _read(owner.definition(package), entry.name)
                        if read is None or not declared_by(owner, package).types.get(entry.name):
                            continue
                        where = place_of(owner.package, read.location, package)
                        message = (
                            f"an empty list leaves {entry.name!r} unset, but {where} reads it: "
                            f"ParameterUninitializedException"
                        )
                        yield self.report(entry.value, message)
                        break


def _is_of_nav2(package: Package, file: ParameterFile) -> bool:
    """Return whether only launch files of Nav2 read a parameter file."""
    is_about = any(section.name in _SERVERS for section in file.sections)
    return is_about and is_of_nav2(package) and not use_of(package, file.path).nodes


def _read(owner: NodeDefinition, name: str) -> ParameterRead | None:
    """Return a place where the node fails if a parameter has no value."""
    current: NodeDefinition | None = owner
    while current is not None:
        for read in current.parameter_reads:
            if read.name == name and read.method == "get_parameter":
                module = current.file.module
                is_handled_here = is_handled(module, read.call, "ParameterUninitializedException")
                if not is_handled_here and not _is_asked_before(current, read):
                    return read
        current = current.base if isinstance(current, NodeClass) else None
    return None


def _is_asked_before(owner: NodeDefinition, read: ParameterRead) -> bool:
    """Return whether a condition on a parameter that may be unset decides about a read.

    That of another parameter counts as well: their lists are often empty together.
    """
    module = owner.file.module
    return any(
        isinstance(part, ast.Attribute) and part.attr in _ASKING
        for condition in conditions_on(module, read.call)
        for value in values_asked(module, condition)
        for part in ast.walk(value)
    )
