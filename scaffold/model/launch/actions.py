"""The lists of actions of a Python launch file."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from typing import TYPE_CHECKING

from scaffold.model.launch.calls import launch_call
from scaffold.model.launch.python_file import NODES, LaunchFile
from scaffold.model.python.evaluation.returns import is_generator, returned
from scaffold.record import NamedTuple

if TYPE_CHECKING:
    from scaffold.model.python.scopes import FunctionNode

HANDLERS = ("OnExecutionComplete", "OnProcessExit", "OnProcessIO", "OnProcessStart", "OnShutdown")
CALLBACKS = ("on_completion", "on_exit", "on_start", "on_shutdown")
"""Arguments of handlers that accept actions, or a function that returns some."""

_LISTS = {"LaunchDescription": "initial_entities", "GroupAction": "actions"} | {
    "TimerAction": "actions"
}
_CONDITIONS = ("IfCondition", "UnlessCondition")
_VALUES = (
    *("ComposableNode", "ParameterFile", "ParameterValue", "LaunchConfiguration", "Command"),
    *("FindPackageShare", *_CONDITIONS),
)
_WITH_CALLBACKS = (*HANDLERS, *NODES, "ExecuteProcess")
_MANY = ("LaunchDescription", "GroupAction", "TimerAction", "OpaqueFunction")
"""Callables that only accept lists; another rule checks other arguments."""


class Entity(NamedTuple):
    """An item of a list of actions, or an argument in place of such a list."""

    node: ast.expr
    holder: str
    """The callable that receives it, such as ``LaunchDescription``."""
    argument: str = ""
    """The argument that receives it."""
    is_alone: bool = False
    """Whether it is not an item of a list, as handlers accept functions as well."""

    @property
    def taker(self) -> str:
        """The receiving callable, for messages."""
        return f"{self.argument!r} of {self.holder}" if self.argument else self.holder


def entities(launch: LaunchFile) -> Iterator[Entity]:
    """Yield the items of literal lists of actions."""
    seen: set[ast.expr] = set()
    for holder, argument, node in _lists(launch):
        listed = _literal_of(launch, node)
        if not isinstance(listed, ast.List):
            if holder not in _MANY:
                yield Entity(node, holder, argument, is_alone=True)
            continue
        for item in listed.elts:
            if item not in seen:
                seen.add(item)
                yield Entity(item, holder, argument)
    for added in launch.module.walk(ast.Call):
        match added:
            case ast.Call(func=ast.Attribute(value=description, attr="add_action"), args=[item]):
                made = launch.call_of(description)
                if made is not None and made.kind == "LaunchDescription":
                    yield Entity(item, "add_action()")


def _lists(launch: LaunchFile) -> Iterator[tuple[str, str, ast.expr]]:
    """Yield callables that receive actions, with the name and value of the argument."""
    for call in launch.calls:
        name = _LISTS.get(call.kind)
        if name is not None and name in call.given:
            yield call.kind, "", call.given[name]
        elif call.kind in _WITH_CALLBACKS:
            for argument in CALLBACKS:
                if argument in call.given:
                    yield call.kind, argument, call.given[argument]
        elif call.kind == "OpaqueFunction":
            for value in _returned_by(launch, call.given.get("function")):
                yield call.kind, "", value


def _returned_by(launch: LaunchFile, node: ast.expr | None) -> list[ast.expr]:
    function = function_of(launch, node)
    if function is None or is_generator(function) or function.decorator_list:
        return []
    return [statement.value for statement in returned(function) if statement.value is not None]


def _literal_of(launch: LaunchFile, node: ast.expr) -> ast.expr:
    """Return the only value of a name."""
    for _ in range(5):
        value = _value_of(launch, node) if isinstance(node, ast.Name) else None
        if value is None:
            break
        node = value
    return node


def function_of(launch: LaunchFile, node: ast.expr | None) -> FunctionNode | None:
    """Return the function of the file that an expression names."""
    if not isinstance(node, ast.Name):
        return None
    function = launch.module.functions.get(node.id)
    if (
        function is None
        or len(launch.module.index.bindings(launch.module.tree).get(node.id, ())) > 1
    ):
        return None
    return function.node


def describe(launch: LaunchFile, node: ast.expr) -> str:
    """Describe an expression that is certainly no action: ``this is a list``."""
    node = _literal_of(launch, node)
    if isinstance(node, ast.Name) and function_of(launch, node) is not None:
        return "this is a function"
    names = launch.module.qualified_names(node)
    if any(_is_action_class(name) for name in names):
        return "this is a class"
    if isinstance(node, ast.Call):
        return _described(launch, node)
    return _literal(node)


def _value_of(launch: LaunchFile, node: ast.Name) -> ast.expr | None:
    return launch.module.index.only_value(node)


def _is_action_class(name: str) -> bool:
    return name.startswith(("launch.actions.", "launch_ros.actions.")) and name.count(".") == 2  # noqa: PLR2004  module and class


def _literal(node: ast.expr) -> str:
    kind = ""
    match node:
        case ast.List() | ast.ListComp():
            kind = "this is a list"
        case ast.Tuple():
            kind = "this is a tuple"
        case ast.Dict() | ast.DictComp():
            kind = "this is a dictionary"
        case ast.Constant(value=None):
            kind = "this is None"
        case ast.Constant(value=str()) | ast.JoinedStr():
            kind = "this is a string"
        case ast.Constant(value=bool() | int() | float()):
            kind = "this is a number"
    return kind


def _described(launch: LaunchFile, node: ast.Call) -> str:
    names = launch.module.qualified_names(node.func)
    if any(name.startswith(("launch.events.", "launch_ros.events.")) for name in names):
        return "this is an event"
    call = launch_call(launch.module, node)
    kind = call.kind if call is not None else ""
    if kind in HANDLERS:
        return f"this is the handler {kind}"
    if kind in _VALUES or kind.endswith(("Substitution", "Source", "Expression")):
        article = "an" if kind.startswith(tuple("AEIOU")) else "a"
        return f"this is {article} {kind}"
    return "this is a string" if kind == "get_package_share_directory" else ""
