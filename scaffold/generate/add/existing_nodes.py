"""The nodes of an existing package, as variables for the templates of extras."""

from __future__ import annotations

import ast
import re
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, NamedTuple

from scaffold.generate.add.cpp_nodes import executables
from scaffold.model.package import Package
from scaffold.model.parameters.files import parameter_files
from scaffold.model.programs.executables import nodes_of, programs_of
from scaffold.model.python.evaluation.values import Unknown
from scaffold.source import ViewError

LIBRARY_NODES = frozenset({"nav2_simple_commander.robot_navigator.BasicNavigator"})
"""Node classes of libraries that programs derive from or instantiate."""
CONFIG = "config"
"""Where generated launch files look for parameter files."""


class FoundNodes(NamedTuple):
    """The nodes of a package, for launch files."""

    nodes: Sequence[Mapping[str, Any]]
    """Each with at least ``name``, ``executable``, ``parameter_file`` and ``has_parameters``."""
    others: Sequence[str]
    """Programs that may or may not be nodes."""


def find(
    package: Package,
    recorded: Sequence[Mapping[str, Any]],
    compiled: Sequence[Mapping[str, Any]] = (),
) -> FoundNodes:
    """Return the nodes of a package.

    Args:
        package: The package as it is.
        recorded: The nodes that it was created with; removed ones are skipped.
        compiled: The C++ programs that it was made with; they are not nodes.
    """
    programs = programs_of(package)
    kept = [
        node for node in recorded if node["executable"] in programs.sources or not programs.complete
    ]
    known_programs = {node["executable"] for node in recorded} | {item["name"] for item in compiled}
    result: list[Mapping[str, Any]] = list(kept)
    others: list[str] = []
    in_cpp = executables(package)
    for program, source in programs.sources.items():
        is_library = package.build_type == "ament_cmake" and not source and program not in in_cpp
        if program in known_programs or is_library:
            continue
        names = {owner.node_name for owner in nodes_of(package, program)}
        if names or in_cpp.get(program) or _makes_library_node(package, source):
            result.append(_node(package, program, names))
        else:
            others.append(program)
    return FoundNodes(list(_renamed(result)), others)


def _makes_library_node(package: Package, path: str) -> bool:
    """Return whether a file derives from or instantiates a node class of a library."""
    try:
        module = package.module(path)
    except ViewError:
        return False
    bases = [base for node in module.walk(ast.ClassDef) for base in node.bases]
    used = bases + [node.func for node in module.walk(ast.Call)]
    return any(not LIBRARY_NODES.isdisjoint(module.qualified_names(item)) for item in used)


def _node(package: Package, program: str, names: set[str | Unknown]) -> dict[str, Any]:
    """Return the variables of a launch file for a program that creates nodes."""
    name = next(iter(names)) if len(names) == 1 else None
    file = _parameters(package, name) if isinstance(name, str) else ""
    return {
        "name": name if isinstance(name, str) else "",
        "executable": program,
        "parameter_file": file,
        "has_parameters": bool(file),
    }


def _parameters(package: Package, name: str) -> str:
    """Return the only parameter file for a node of this name; empty if there is none."""
    fitting = [
        file.path
        for file in parameter_files(package)
        if file.path.rpartition("/")[0] == CONFIG
        and any(section.node.rpartition("/")[2] == name for section in file.sections)
    ]
    return fitting[0] if len(fitting) == 1 else ""


def _renamed(nodes: Sequence[Mapping[str, Any]]) -> Iterator[Mapping[str, Any]]:
    """Yield nodes; those with equal names get the names of their programs."""
    count = Counter(node["name"] for node in nodes if node["name"])
    for node in nodes:
        if count[node["name"]] > 1:
            name = re.sub(r"\W", "_", node["executable"].removesuffix(".py"))
            yield {**node, "launch_name": name, "parameter_file": "", "has_parameters": False}
        else:
            yield node
