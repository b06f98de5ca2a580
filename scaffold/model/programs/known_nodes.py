"""The nodes in the Python code of a package, for use by other files."""

from __future__ import annotations

from typing import TYPE_CHECKING

from scaffold.model.facts import fact
from scaffold.model.python.evaluation.values import Unknown
from scaffold.model.rclpy.file import rclpy_file
from scaffold.model.rclpy.nodes import NodeClass
from scaffold.record import NamedTuple

if TYPE_CHECKING:
    from scaffold.model.package import Package
    from scaffold.model.rclpy.nodes import NodeDefinition


class KnownNode(NamedTuple):
    """A node that the code of a file creates; `definition` has the details."""

    package: str
    """The name of the package with the file."""
    path: str
    number: int
    """Its index among the nodes of the file."""
    name: str
    """The name of the class or the variable."""
    node_name: str | Unknown
    has_namespace: bool
    is_class: bool
    """Whether it has its own class."""

    def home(self, package: Package) -> Package:
        """Return the package with its code, as seen from another one."""
        if self.package == package.name:
            return package
        return package.workspace.get(self.package) or package

    def definition(self, package: Package) -> NodeDefinition:
        """Return the code of the node; raises ViewError."""
        return rclpy_file(self.home(package), self.path).nodes[self.number]


@fact
def known_nodes(package: Package, path: str) -> tuple[KnownNode, ...]:
    """Return the nodes that a Python file creates; raises ViewError."""
    return tuple(
        KnownNode(
            package.name,
            path,
            number,
            node.name,
            node.node_name,
            node.namespace is not None,
            isinstance(node, NodeClass),
        )
        for number, node in enumerate(rclpy_file(package, path).nodes)
    )
