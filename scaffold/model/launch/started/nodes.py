"""The nodes that Python launch files start: names, namespaces, parameters, programs."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator, Sequence
from contextlib import suppress
from typing import TYPE_CHECKING

from scaffold.model.facts import fact
from scaffold.model.launch.actions import function_of
from scaffold.model.launch.calls import LaunchCall
from scaffold.model.launch.evaluation.evaluator import share_path
from scaffold.model.launch.markup_file import changes_name
from scaffold.model.launch.python_file import NODES, LaunchFile, launch_paths
from scaffold.model.launch.started.parameter_values import GivenValue, value_given
from scaffold.model.programs.executables import nodes_of
from scaffold.model.python.evaluation.values import UNKNOWN, Unknown
from scaffold.model.remembered import remembered_list
from scaffold.record import NamedTuple
from scaffold.source import Location, ViewError

if TYPE_CHECKING:
    from scaffold.model.package import Package
    from scaffold.model.programs.known_nodes import KnownNode

_SCOPES = ("GroupAction", "PushRosNamespace", "PushROSNamespace")
_PUSHES = ("PushRosNamespace", "PushROSNamespace")
_LISTS = ("LaunchDescription", "add_action")
_ARGUMENTS = frozenset({"arguments", "ros_arguments"})
_SETTERS = ("SetParameter", "SetParametersFromFile")
"""Names that may set parameters in other ways."""


class GivenParameter(NamedTuple):
    """A parameter that a launch file sets directly on a node."""

    name: str
    key_location: Location
    location: Location
    """The location of the value."""
    value: GivenValue | None
    configuration: str | Unknown | None
    """The name of the launch configuration that is the value, if it is one."""
    has_choices: bool
    """Whether it has choices, all of which are strings in YAML."""
    later_files: tuple[str, ...]
    """The files of the own package that follow, and override it; see ``parameter_files``."""


class StartedNode(NamedTuple):
    """A node that a launch file starts."""

    launch: str
    """The path of the launch file."""
    location: Location
    """The location of the called name."""
    package: str | Unknown | None
    executable: str | Unknown | None
    namespace: str | Unknown | None
    given_name: str | Unknown | None
    name_location: Location
    """The location of the name, or of the action without one."""
    namespace_location: Location
    """The location of the namespace, or of the action without one."""
    is_component: bool
    is_scoped: bool
    """Whether other actions may put it into another namespace."""
    is_certain: bool
    """Whether it is always started: under no condition, in no group."""
    has_parameters: bool
    parameter_files: tuple[tuple[str, bool], ...]
    """The parameter files of the own package, relative to its share directory.

    The default of a launch argument counts too. With whether the launch file gives it to others,
    too: to a file that it includes, or as the source of a copy.
    """
    parameters: tuple[GivenParameter, ...]
    """The single parameters."""
    has_more_parameters: bool
    """Whether files or unknown expressions give more."""
    remappings: tuple[tuple[str, str | None, Location], ...]
    """The known remapped names, with their targets and locations."""
    default_namespace: str
    """The namespace of its group, unless an argument sets another one."""

    def owner(self, package: Package) -> KnownNode | None:
        """Return its code, if it is Python in this package or the workspace."""
        if not isinstance(self.executable, str) or not isinstance(self.package, str):
            return None
        return code_of(package, self.package, self.executable)

    def _own_code(self, package: Package) -> KnownNode | None:
        return self.owner(package) if self.package == package.name else None

    def name(self, package: Package) -> str | Unknown:
        """Return the given name, or that in the code of the node."""
        if self.given_name is not None:
            return self.given_name
        owner = self._own_code(package)
        return owner.node_name if owner is not None else UNKNOWN

    def full_name(self, package: Package) -> str | None:
        """Return namespace and name, ``/robot1/talker``; ``None`` if one is unknown."""
        name = self.name(package)
        if not isinstance(name, str) or isinstance(self.namespace, Unknown):
            return None
        namespace = (self.namespace or "").strip("/")
        owner = self._own_code(package) if self.namespace is None else None
        if owner is not None and owner.has_namespace:
            return None
        return f"/{namespace}/{name}" if namespace else f"/{name}"


def code_of(package: Package, name: str, program: str) -> KnownNode | None:
    """Return the code of a node if it is Python in this package or one of the workspace.

    Args:
        package: The package with the launch file.
        name: The name of the package with the node.
        program: The executable.
    """
    owner = package if name == package.name else package.workspace.get(name)
    nodes = nodes_of(owner, program) if owner is not None else []
    return nodes[0] if len(nodes) == 1 else None


def started_nodes(package: Package) -> list[StartedNode]:
    """Return the nodes that the Python launch files of a package start."""
    return [node for node in _all_started(package) if not node.is_component]


def consumers(package: Package) -> list[StartedNode]:
    """Return the nodes and components with parameters in Python launch files."""
    return [node for node in _all_started(package) if node.has_parameters]


@remembered_list
def _all_started(package: Package) -> Iterator[StartedNode]:
    for path in launch_paths(package):
        with suppress(ViewError):
            yield from _started_by(package, path)


@fact
def _started_by(package: Package, path: str) -> tuple[StartedNode, ...]:
    launch = LaunchFile.of(package, path)
    return tuple(_started(launch, call) for call in launch.find(*NODES, "ComposableNode"))


def _started(launch: LaunchFile, call: LaunchCall) -> StartedNode:
    is_scoped = bool(launch.find(*_SCOPES)) or _runs_code_of_others(launch)
    is_doubtful = (
        is_scoped
        or bool(launch.find("OpaqueFunction"))
        or "condition" in call.given
        or call.is_open
    )

    def place(name: str) -> Location:
        node = call.given.get(name)
        return launch.location(node) if node is not None else call.location

    return StartedNode(
        launch.path,
        call.location,
        launch.text(call, "package"),
        launch.text(call, "executable"),
        launch.text(call, "namespace"),
        launch.text(call, "name"),
        place("name"),
        place("namespace"),
        call.kind == "ComposableNode",
        is_scoped,
        not is_doubtful and _is_listed(launch, call.call),
        "parameters" in call.given,
        tuple(_parameter_files(launch, call)),
        tuple(_given(launch, call, *item) for item in parameters_given(launch, call)),
        _has_more_parameters(launch, call),
        tuple(_remappings(launch, call)),
        _default_namespace(launch, call),
    )


def _runs_code_of_others(launch: LaunchFile) -> bool:
    """Return whether a launch file executes functions that it does not define."""
    calls = launch.find("OpaqueFunction")
    return any(function_of(launch, call.given.get("function")) is None for call in calls)


def _default_namespace(launch: LaunchFile, call: LaunchCall) -> str:
    """Return the default namespace pushed in the group of a node; empty if none."""
    pushes = launch.find(*_PUSHES)
    if len(pushes) != 1 or "namespace" in call.given or call.is_open:
        return ""
    given = pushes[0].given.get("namespace")
    if given is None and pushes[0].call.args:
        given = pushes[0].call.args[0]
    text = launch.evaluator.joined_text(given)
    text = launch.default_of(given) if isinstance(text, Unknown) else text
    for group in launch.find("GroupAction"):
        items = [item.node for item in launch.evaluator.elements(_actions(group)).items]
        calls = [launch.call_of(item) for item in items]
        nodes = [item.call for item in calls if item is not None]
        if call.call in nodes and pushes[0].call in nodes and isinstance(text, str):
            is_later = nodes.index(pushes[0].call) < nodes.index(call.call)
            return text.strip("/") if is_later else ""
    return ""


def _actions(group: LaunchCall) -> ast.expr:
    """Return the list of a group."""
    given = group.given.get("actions")
    if given is None and group.call.args:
        given = group.call.args[0]
    return given or ast.List([], ast.Load())


# -- parameters


def parameter_items(launch: LaunchFile, call: LaunchCall) -> Sequence[ast.expr]:
    """Return the items of ``parameters=``."""
    node = call.given.get("parameters")
    if node is None:
        return ()
    return [item.node for item in launch.evaluator.elements(node).items]


def parameters_given(
    launch: LaunchFile, call: LaunchCall
) -> Iterator[tuple[str, ast.expr, ast.expr]]:
    """Yield name, location of the name, and value of single parameters."""
    for node in parameter_items(launch, call):
        literal = launch.module.index.only_value(node) or node
        if isinstance(literal, ast.Dict):
            yield from _given_in(launch, literal, "")


def _given_in(
    launch: LaunchFile, literal: ast.Dict, prefix: str
) -> Iterator[tuple[str, ast.expr, ast.expr]]:
    """Yield the parameters of a dictionary; names in nested ones are joined with dots."""
    for key, value in zip(literal.keys, literal.values, strict=True):
        name = launch.evaluator.text(key)
        if key is None or not isinstance(name, str):
            continue
        if isinstance(value, ast.Dict):
            yield from _given_in(launch, value, f"{prefix}{name}.")
        else:
            yield f"{prefix}{name}", key, value


def _given(
    launch: LaunchFile, node: LaunchCall, name: str, key: ast.expr, value: ast.expr
) -> GivenParameter:
    call = launch.call_of(value)
    is_configuration = call is not None and call.kind == "LaunchConfiguration"
    configuration = launch.text(call, "variable_name") if call and is_configuration else None
    return GivenParameter(
        name,
        launch.location(key),
        launch.location(value),
        value_given(launch, value),
        configuration,
        call is not None and is_configuration and _has_choices(launch, call),
        tuple(_files_after(launch, node, key)),
    )


def _files_after(launch: LaunchFile, call: LaunchCall, key: ast.expr) -> Iterator[str]:
    """Yield the parameter files after the dictionary with a key."""
    items = parameter_items(launch, call)
    literals = [launch.module.index.only_value(item) or item for item in items]
    holders = (index for index, item in enumerate(literals) if key in ast.walk(item))
    for item in items[next(holders, len(items)) :]:
        path = share_path(_file_of(launch, item))
        if path is not None and path[0] == launch.package_name:
            yield path[1]


def _has_more_parameters(launch: LaunchFile, call: LaunchCall) -> bool:
    if call.is_open or not _ARGUMENTS.isdisjoint(call.given) or launch.find(*_SETTERS):
        return True
    given = call.given.get("parameters")
    if given is not None and not launch.evaluator.elements(given).complete:
        return True
    return not all(_is_dictionary(launch, item) for item in parameter_items(launch, call))


def _is_dictionary(launch: LaunchFile, node: ast.expr) -> bool:
    """Return whether an item of ``parameters=`` is a dictionary with known names.

    Also through a variable.
    """
    values: list[ast.expr] = [node]
    if isinstance(node, ast.Name):
        values = [x.value for x in launch.module.index.bindings_of(node) if x.value is not None]
    return bool(values) and all(
        isinstance(value, ast.Dict)
        and all(isinstance(launch.evaluator.text(key), str) for key in value.keys)
        for value in values
    )


def _remappings(launch: LaunchFile, call: LaunchCall) -> Iterator[tuple[str, str | None, Location]]:
    given = call.given.get("remappings")
    elements = launch.evaluator.elements(given).items if given is not None else ()
    for element in elements:
        match element.node:
            case ast.Tuple(elts=[source, target]) | ast.List(elts=[source, target]):
                text = launch.evaluator.text(source)
                other = launch.evaluator.text(target)
                if isinstance(text, str) and changes_name(text, other):
                    other_text = other if isinstance(other, str) else None
                    yield text, other_text, launch.location(source)


def _has_choices(launch: LaunchFile, configuration: LaunchCall) -> bool:
    """Return whether an argument has choices, all of which are strings in YAML."""
    name = launch.evaluator.evaluate(configuration.given.get("variable_name"))
    for call in launch.calls:
        if call.kind == "DeclareLaunchArgument" and "choices" in call.given:
            choices = launch.evaluator.evaluate(call.given["choices"])
            if launch.evaluator.evaluate(call.given.get("name")) == name:
                return isinstance(choices, list | tuple) and all(map(_is_text, choices))
    return False


def _is_text(value: object) -> bool:
    """Return whether YAML reads a word as a string."""
    return (
        isinstance(value, str)
        and re.fullmatch(r"[A-Za-z_][\w-]*", value) is not None
        and value.lower() not in {"true", "false", "yes", "no", "on", "off", "null", "y", "n"}
    )


def _parameter_files(launch: LaunchFile, call: LaunchCall) -> Iterator[tuple[str, bool]]:
    for node in parameter_items(launch, call):
        path = share_path(_file_of(launch, node))
        if path is not None and path[0] == launch.package_name:
            yield path[1], _is_handed_on(launch, node)


def _file_of(launch: LaunchFile, node: ast.expr) -> str | Unknown:
    call = launch.call_of(node)
    if call is not None and call.kind == "ParameterFile":
        inner = call.given.get("param_file")
        return UNKNOWN if inner is None else _file_of(launch, inner)
    if call is not None and call.kind == "LaunchConfiguration":
        return launch.default_of(node)
    return launch.evaluator.joined_text(node)


def _is_handed_on(launch: LaunchFile, expression: ast.expr) -> bool:
    """Return whether a launch file passes a parameter file to more than the node.

    To an included file, or as ``source_file`` to RewrittenYaml, which makes a copy for nodes.
    """
    text = launch.module.text(expression)
    included = [
        call.given["launch_arguments"]
        for call in launch.find("IncludeLaunchDescription")
        if "launch_arguments" in call.given
    ]
    sources = [word.value for word in launch.module.walk(ast.keyword) if word.arg == "source_file"]
    return any(text in launch.module.text(given) for given in (*included, *sources))


def _is_listed(launch: LaunchFile, call: ast.Call) -> bool:
    """Return whether an action is in the list of the LaunchDescription, or is added to it."""
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
