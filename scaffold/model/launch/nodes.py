"""The nodes that Python launch files start: names, namespaces, parameters, programs."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Sequence
from functools import cached_property
from typing import TYPE_CHECKING

from scaffold.model.launch.python_file import NODES, LaunchCall, LaunchFile, share_path
from scaffold.model.programs.executables import nodes_of
from scaffold.model.python.values import UNKNOWN, Unknown

if TYPE_CHECKING:
    from scaffold.model.package import Package
    from scaffold.model.rclpy.nodes import NodeDefinition
    from scaffold.source import Location

_SCOPES = ("GroupAction", "PushRosNamespace", "PushROSNamespace", "OpaqueFunction")
_LISTS = ("LaunchDescription", "add_action")


class StartedNode:
    """A node that a launch file starts."""

    def __init__(self, package: Package, launch: LaunchFile, call: LaunchCall) -> None:
        self.launch = launch
        self.call = call
        self.package = launch.text(call, "package")
        self.executable = launch.text(call, "executable")
        self.namespace = launch.text(call, "namespace")
        self._given_name = launch.text(call, "name")
        self._own = package

    @property
    def owner(self) -> NodeDefinition | None:
        """The code of the node, when it is Python of this package or one of the workspace."""
        if not isinstance(self.executable, str) or not isinstance(self.package, str):
            return None
        return code_of(self._own, self.package, self.executable)

    @property
    def _own_code(self) -> NodeDefinition | None:
        return self.owner if self.package == self._own.name else None

    @property
    def name(self) -> str | Unknown:
        """The name as given, or as the code of the node gives it."""
        if self._given_name is not None:
            return self._given_name
        owner = self._own_code
        return owner.node_name if owner is not None else UNKNOWN

    @property
    def full_name(self) -> str | None:
        """Name and namespace, ``/robot1/talker``; ``None`` when one of them is not known."""
        name = self.name
        if not isinstance(name, str) or self.namespace is UNKNOWN:
            return None
        namespace = (self.namespace or "").strip("/")
        owner = self._own_code if self.namespace is None else None
        if owner is not None and owner.namespace is not None:
            return None
        return f"/{namespace}/{name}" if namespace else f"/{name}"

    @property
    def name_location(self) -> Location:
        """The place of the name; without one, of the action."""
        node = self.call.given.get("name")
        return self.launch.location(node) if node is not None else self.call.location

    @property
    def namespace_location(self) -> Location:
        """The place of the namespace; without one, of the action."""
        node = self.call.given.get("namespace")
        return self.launch.location(node) if node is not None else self.call.location

    @property
    def is_scoped(self) -> bool:
        """Whether something in the file may put it into another namespace."""
        return bool(self.launch.find(*_SCOPES))

    @property
    def is_certain(self) -> bool:
        """Whether it is started whenever the file is: under no condition, in no group."""
        if self.is_scoped or "condition" in self.call.given or self.call.is_open:
            return False
        return _is_listed(self.launch, self.call.call)

    @cached_property
    def parameters(self) -> Sequence[ast.expr]:
        """The items of ``parameters=``, where they are written; see ``parameters_complete``."""
        node = self.call.given.get("parameters")
        if node is None:
            return ()
        return [item.node for item in self.launch.evaluator.elements(node).items]

    @cached_property
    def parameter_files(self) -> Sequence[tuple[str, ast.expr]]:
        """The parameter files of the own package, relative to its share directory.

        The default of a launch argument counts too.
        """
        result: list[tuple[str, ast.expr]] = []
        for node in self.parameters:
            path = share_path(self._file_of(node))
            if path is not None and path[0] == self._own.name:
                result.append((path[1], node))
        return result

    def _file_of(self, node: ast.expr) -> str | Unknown:
        call = self.launch.call_of(node)
        if call is not None and call.kind == "ParameterFile":
            inner = call.given.get("param_file")
            return UNKNOWN if inner is None else self._file_of(inner)
        if call is not None and call.kind == "LaunchConfiguration":
            return self.launch.default_of(node)
        return self.launch.evaluator.joined_text(node)

    @property
    def parameter_dicts(self) -> Iterator[tuple[str, ast.expr, ast.expr]]:
        """Yield name, name's place and value of the parameters that are given one by one."""
        for node in self.parameters:
            literal: ast.expr | None = node
            if isinstance(node, ast.Name):
                found = self.launch.module.index.lookup(node.id, node)
                values = [binding.value for binding in found[1]] if found else []
                literal = values[0] if len(values) == 1 else None
            if isinstance(literal, ast.Dict):
                yield from self._given_in(literal, "")

    def _given_in(self, literal: ast.Dict, prefix: str) -> Iterator[tuple[str, ast.expr, ast.expr]]:
        """Yield what a dictionary gives; launch joins the names of those inside with points."""
        for key, value in zip(literal.keys, literal.values, strict=True):
            name = self.launch.evaluator.text(key)
            if key is None or not isinstance(name, str):
                continue
            if isinstance(value, ast.Dict):
                yield from self._given_in(value, f"{prefix}{name}.")
            else:
                yield f"{prefix}{name}", key, value


def code_of(package: Package, name: str, program: str) -> NodeDefinition | None:
    """Return the code of a node if it is Python in this package or one of the workspace.

    Args:
        package: The package with the launch file.
        name: The name of the package with the node.
        program: What is started.
    """
    home = package if name == package.name else package.workspace.get(name)
    nodes = nodes_of(home, program) if home is not None else []
    return nodes[0] if len(nodes) == 1 else None


def started_nodes(package: Package) -> list[StartedNode]:
    """Return the nodes that the Python launch files of a package start."""

    def find() -> list[StartedNode]:
        return [
            StartedNode(package, launch, call)
            for launch in LaunchFile.of_package(package)
            for call in launch.find(*NODES)
        ]

    return package.remember("started_nodes", find)


def consumers(package: Package) -> list[StartedNode]:
    """Return the nodes and components that the Python launch files give parameters."""

    def find() -> list[StartedNode]:
        return [
            StartedNode(package, launch, call)
            for launch in LaunchFile.of_package(package)
            for call in launch.find(*NODES, "ComposableNode")
            if "parameters" in call.given
        ]

    return package.remember("parameter_consumers", find)


def _is_listed(launch: LaunchFile, call: ast.Call) -> bool:
    """Tell whether an action is in the list of the LaunchDescription, or is added to it."""
    module = launch.module
    for parent in module.parents(call):
        if isinstance(parent, ast.If | ast.For | ast.While | ast.IfExp | ast.Try | ast.match_case):
            return False
        if isinstance(parent, ast.comprehension | ast.ListComp | ast.GeneratorExp):
            return False
    holder = module.parent(call)
    if isinstance(holder, ast.Assign) and len(holder.targets) == 1:
        target = holder.targets[0]
        if not isinstance(target, ast.Name):
            return False
        uses = [name for name in module.walk(ast.Name) if name.id == target.id]
        loads = [name for name in uses if isinstance(name.ctx, ast.Load)]
        # Set once and used once.
        return len(uses) - 1 == len(loads) == 1 and _is_entity(launch, loads[0])
    return _is_entity(launch, call)


def _is_entity(launch: LaunchFile, node: ast.expr) -> bool:
    module = launch.module
    parent = module.parent(node)
    if any(isinstance(above, ast.If | ast.For | ast.IfExp) for above in module.parents(node)):
        return False
    holder = module.parent(parent) if isinstance(parent, ast.List) else parent
    if isinstance(holder, ast.keyword):
        holder = module.parent(holder)
    if not isinstance(holder, ast.Call):
        return False
    name = holder.func.attr if isinstance(holder.func, ast.Attribute) else ""
    if isinstance(holder.func, ast.Name):
        name = holder.func.id
    return name in _LISTS
