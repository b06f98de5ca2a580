"""The Python files of a package that use rclpy."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import suppress

from scaffold import lazy_re
from scaffold.model.facts import fact
from scaffold.model.package import Package
from scaffold.model.python.module import is_in_tests
from scaffold.model.rclpy.file import RclpyFile, rclpy_file
from scaffold.model.remembered import remembered_list
from scaffold.source import ViewError


@remembered_list
def rclpy_paths(package: Package) -> Iterator[str]:
    """Return the Python files that use rclpy, except tests, which may misuse it on purpose.

    One that gets a node, or is part of one, need not import it.
    """
    for path in package.python_files:
        with suppress(ViewError):
            if "rclpy" not in package.imports(path) and not _uses_a_node(package, path):
                continue
            if not is_in_tests(path) or not package.module(path).in_tests:
                yield path


_OF_NODES = lazy_re.compile(
    rb"\.(?:create_(?:publisher|subscription|service|client|timer|rate)|call_async"
    rb"|(?:declare|get)_parameter|send_goal_async|get_logger\(\)\.\w+|get_clock)\("
)
"""Matches the use of a node or a client of rclpy."""


@fact
def _uses_a_node(package: Package, path: str) -> bool:
    """Return whether a file calls methods of nodes."""
    return _OF_NODES.search(package.data(path)) is not None and "rospy" not in package.imports(path)


def rclpy_files(package: Package, *, mentioning: Sequence[str] = ()) -> Iterator[RclpyFile]:
    """Yield the rclpy views of Python files that import rclpy, except tests.

    Args:
        package: The package.
        mentioning: Words without which a file is of no interest; it is not even parsed.
    """
    for module in package.modules(rclpy_paths(package), mentioning):
        yield rclpy_file(package, module.path)
