"""How the modules of the engine depend on each other; `make lint` checks the layers."""

from __future__ import annotations

import sys
from collections.abc import Mapping
from graphlib import CycleError, TopologicalSorter

import grimp

MODEL = "scaffold.model"
CIRCLES_OF_TYPES = {
    # Entities know the node that makes them, nodes the file that they are in, which lists both.
    "scaffold.model.rclpy.file": frozenset(
        f"{MODEL}.rclpy.{name}" for name in ("running.callbacks", "creation", "entities", "nodes")
    ),
    # The view of a file has its calls of own functions, which the views of other files define.
    f"{MODEL}.messages.inference": frozenset({f"{MODEL}.messages.passed"}),
}
"""Modules that need each other for types, by one of them: what they are about refers to itself."""


def imports_of_modules(*, with_types: bool) -> Mapping[str, set[str]]:
    """Return what each module imports."""
    graph = grimp.build_graph(
        "scaffold", exclude_type_checking_imports=not with_types, cache_dir=None
    )
    return {name: graph.find_modules_directly_imported_by(name) for name in graph.modules}


def assert_no_cycle(imported: Mapping[str, set[str]]) -> None:
    """Fail with the first modules that form an import cycle."""
    try:
        TopologicalSorter(imported).prepare()
    except CycleError as error:
        raise AssertionError(" -> ".join(error.args[1])) from None


INSTALLED = {
    *("argcomplete", "jinja2", "lxml", "packaging", "prompt_toolkit", "pyflakes", "rich", "tqdm"),
    "yaml",
    "tomli",  # before Python 3.11
}
"""The packages among `dependencies` in pyproject.toml that the engine imports."""


def test_external_imports_are_declared_dependencies() -> None:
    graph = grimp.build_graph(
        "scaffold",
        include_external_packages=True,
        exclude_type_checking_imports=True,
        cache_dir=None,
    )
    external = {name for name in graph.modules if name.partition(".")[0] != "scaffold"}
    assert external - sys.stdlib_module_names <= INSTALLED


def test_no_import_cycles() -> None:
    assert_no_cycle(imports_of_modules(with_types=False))


def test_type_only_import_cycles_are_the_listed_ones() -> None:
    imported = imports_of_modules(with_types=True)
    center_of = {name: center for center, names in CIRCLES_OF_TYPES.items() for name in names}
    merged: dict[str, set[str]] = {}
    for name, others in imported.items():
        center = center_of.get(name, name)
        merged.setdefault(center, set()).update(
            {center_of.get(other, other) for other in others} - {center}
        )
    assert_no_cycle(merged)
