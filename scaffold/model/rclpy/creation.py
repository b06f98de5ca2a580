"""Turns calls that create something on a node into entities."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING

from scaffold.model.python.evaluation.returns import returned
from scaffold.model.python.evaluation.values import UNKNOWN
from scaffold.model.rclpy.entities import (
    ActionClient,
    ActionServer,
    Argument,
    Callback,
    Client,
    Created,
    Endpoint,
    Entity,
    Parameter,
    ParameterRead,
    Publisher,
    Service,
    Subscription,
    Synchronizer,
    Timer,
)
from scaffold.model.rclpy.evaluation.evaluator import NOTE
from scaffold.model.rclpy.parameters.declarations import SIGNATURES as DECLARATIONS
from scaffold.model.rclpy.parameters.declarations import Declaration
from scaffold.model.rclpy.parameters.descriptors import descriptor_of
from scaffold.model.rclpy.tables import ONCE, Row, rows_of
from scaffold.model.rclpy.topics.qos import PROFILES, Qos, qos_of

if TYPE_CHECKING:
    from scaffold.model.rclpy.file import RclpyFile

_QOS = ("msg_type", "topic", "qos_profile")
_SIGNATURES: Mapping[str, tuple[str, ...]] = {
    "create_publisher": _QOS,
    "create_lifecycle_publisher": _QOS,
    "create_subscription": ("msg_type", "topic", "callback", "qos_profile"),
    "create_service": ("srv_type", "srv_name", "callback"),
    "create_client": ("srv_type", "srv_name"),
    "create_timer": ("timer_period_sec", "callback", "callback_group", "clock", "autostart"),
    **DECLARATIONS,
    "get_parameter": ("name",),
    "get_parameter_or": ("name", "alternative_value"),
    "has_parameter": ("name",),
    "get_parameter_type": ("name",),
    "ActionServer": ("node", "action_type", "action_name", "execute_callback"),
    "ActionClient": ("node", "action_type", "action_name"),
}
_SYNCHRONIZER = ("fs", "queue_size", "slop", "allow_headerless")
_FILTERS: Mapping[str, tuple[str, ...]] = {
    "Subscriber": ("node", "msg_type", "topic"),
    "TimeSynchronizer": _SYNCHRONIZER[:2],
    "ApproximateTimeSynchronizer": _SYNCHRONIZER,
}
"""The classes of ``message_filters``."""
NODE_METHODS = tuple(name for name in _SIGNATURES if name.islower())
"""The methods of a node that create or read something."""
_READS = frozenset({"get_parameter", "get_parameter_or", "has_parameter", "get_parameter_type"})
_ENDPOINTS: Mapping[str, type[Endpoint]] = {
    "create_publisher": Publisher,
    "create_lifecycle_publisher": Publisher,
    "create_subscription": Subscription,
    "create_service": Service,
    "create_client": Client,
    "ActionServer": ActionServer,
    "ActionClient": ActionClient,
    "Subscriber": Subscription,
}
_CLASSES = {
    f"rclpy.action.{module}{kind}": kind
    for kind in ("ActionServer", "ActionClient")
    for module in ("", "server.", "client.")
} | {f"message_filters.{kind}": kind for kind in _FILTERS}
"""The classes whose constructors create something."""
_DEFAULT_DEPTH = 10
"""The default depth of subscriptions of ``message_filters``."""

_PLAIN = (ast.expr, ast.keyword, ast.With, ast.Expr, ast.Assign, ast.AnnAssign)
"""What may be around a call that is executed in any case."""


class Creation:
    """Finds the entities that the calls of a file create."""

    def __init__(self, file: RclpyFile) -> None:
        self._file = file

    def entities(self) -> Iterator[Entity]:
        """Yield everything created, in the order of the text."""
        for call in self._file.module.walk(ast.Call):
            method = self._creating_method(call)
            if method is not None:
                yield from self._created_by(call, method)

    def _creating_method(self, call: ast.Call) -> str | None:
        func = self._file.method_of(call)
        if func is not None and func.attr in NODE_METHODS:
            if self._file.is_node_class(func.value):
                return None  # Node.create_publisher(self, ...) in an override
            is_node = self._file.owner_of(func.value) is not None
            return func.attr if is_node or self._may_be_of_rclpy(func) else None
        for name in self._file.module.qualified_names(call.func):
            if name in _CLASSES:
                return _CLASSES[name]
        return None

    def _may_be_of_rclpy(self, func: ast.Attribute) -> bool:
        """Return whether a method of an unknown object may be that of an rclpy node."""
        if not self._file.uses_rclpy:
            return False
        class_ = self._file.evaluator.self_class(func.value)
        return class_ is None or not self._file.defines(class_, func.attr)

    def _created_by(self, call: ast.Call, method: str) -> Iterator[Entity]:
        for row in self._rows(call, method):
            yield from self._created_in(self._created(call, method, row), method)

    def _rows(self, call: ast.Call, method: str) -> Sequence[Row]:
        """Return what the arguments of a call stand for in each row of the table of its loop."""
        words = (word.value for word in call.keywords)
        return (
            rows_of(self._file.evaluator, (*call.args, *words)) if method in _ENDPOINTS else [ONCE]
        )

    def _created_in(self, created: Created, method: str) -> Iterator[Entity]:
        call = created.call
        evaluator = self._file.evaluator
        if method in _ENDPOINTS:
            yield self._endpoint(created, method)
        elif method in {"TimeSynchronizer", "ApproximateTimeSynchronizer"}:
            yield Synchronizer(
                created,
                inputs=self._inputs(created.arguments.get("fs")),
                callbacks=self._registered(call),
            )
        elif method == "create_timer":
            period = created.arguments.get("timer_period_sec")
            value, notes = evaluator.trace(period.node if period else None)
            is_number = isinstance(value, int | float) and type(value) is not bool
            yield Timer(
                created,
                period=value if isinstance(value, int | float) and is_number else UNKNOWN,
                from_parameters=_parameters_in(notes) if is_number else frozenset(),
                callback=self._callback_argument(created, "callback"),
            )
        elif method in _READS:
            name = created.arguments.get("name")
            text = evaluator.text(name.node) if name else UNKNOWN
            yield ParameterRead(created, method=method, name=text)
        else:
            yield from self._declared(created, method)

    def _endpoint(self, created: Created, method: str) -> Endpoint:
        kind = _ENDPOINTS[method]
        type_ = created.arguments.get(kind.type_parameter)
        name = created.arguments.get(kind.name_parameter)
        text, notes = self._file.evaluator.trace(name.node if name else None)
        qos = self._qos(created, method)
        made = kind(
            created,
            interface=self._file.interface(type_.node) if type_ else None,
            name=text if isinstance(text, str) else UNKNOWN,
            from_parameters=_parameters_in(notes) if isinstance(text, str) else frozenset(),
            qos=qos,
            callback=self._callback_of(created, method),
        )
        if isinstance(made, Publisher):
            made.is_lifecycle = method == "create_lifecycle_publisher"
        return made

    def _qos(self, created: Created, method: str) -> Qos | None:
        given = created.arguments.get("qos_profile")
        if given is not None:
            return self._qos_given(given.node)
        if method == "Subscriber" and not created.has_unknown_arguments:
            more = created.call.args[len(_FILTERS[method]) :]
            if more:  # a TypeError: the value is meant as QoS
                return qos_of(self._file.evaluator, more[0])
            return Qos(created.location, None, _DEFAULT_DEPTH, *PROFILES["default"][1:])
        return None

    def _qos_given(self, node: ast.expr) -> Qos:
        """Return the quality of service of an expression, also through a constant or function."""
        qos = qos_of(self._file.evaluator, node)
        if qos != Qos(qos.location):
            return qos
        file, value = self._defined(node)
        if value is node:
            return qos
        return qos_of(file.evaluator, value)._replace(location=qos.location)

    def _defined(self, node: ast.expr) -> tuple[RclpyFile, ast.expr]:
        """Return the expression behind a constant or function of the package, with its file."""
        value = self._file.evaluator.single_value(node)
        is_call = isinstance(value, ast.Call)
        defined = self._file.definition_of(value.func if isinstance(value, ast.Call) else value)
        if defined is None or is_call is not isinstance(defined[1], ast.FunctionDef):
            return self._file, node
        file, definition = defined
        if isinstance(definition, ast.FunctionDef):
            given = [statement.value for statement in returned(definition)]
            if len(given) != 1 or given[0] is None or definition.decorator_list:
                return self._file, node
            definition = given[0]
        return file, definition

    def _callback_of(self, created: Created, method: str) -> Callback | None:
        if method == "Subscriber":
            return next(iter(self._registered(created.call)), None)
        return self._callback_argument(
            created, "execute_callback" if method == "ActionServer" else "callback"
        )

    def _registered(self, call: ast.Call) -> list[Callback]:
        """Return the callbacks registered with a message filter."""
        result: list[Callback] = []
        for added, method in self._file.module.method_calls("registerCallback"):
            if added.args and self._file.evaluator.single_value(method.value) is call:
                callback = self._file.callback(added.args[0])
                has_more = bool(len(added.args) > 1 or added.keywords)
                result.append(callback._replace(is_partial=callback.is_partial or has_more))
        return result

    def _inputs(self, given: Argument | None) -> list[Endpoint | None] | None:
        """Return the input subscriptions of a synchronizer, if their number is known."""
        if given is None:
            return None
        file, made = self._defined(given.node)
        if file is not self._file:
            return None
        made = file.evaluator.single_value(made)
        if isinstance(made, ast.ListComp) and isinstance(made.elt, ast.Call):
            rows = self._rows(made.elt, "Subscriber")
            return [self._input(made.elt, row) for row in rows] if rows[0].loop else None
        elements = file.evaluator.elements(made)
        if not elements.complete or any(item.conditional for item in elements.items):
            return None
        return [self._input(file.evaluator.single_value(item.node)) for item in elements.items]

    def _input(self, call: ast.expr, row: Row = ONCE) -> Endpoint | None:
        """Return a subscription that is given to a synchronizer; ``None`` if unknown."""
        if not isinstance(call, ast.Call) or self._creating_method(call) != "Subscriber":
            return None
        return self._endpoint(self._created(call, "Subscriber", row), "Subscriber")

    def _created(self, call: ast.Call, method: str, row: Row = ONCE) -> Created:
        arguments: dict[str, Argument] = {}
        unknown = False
        for parameter, arg in zip(
            _SIGNATURES.get(method) or _FILTERS[method], call.args, strict=False
        ):
            if isinstance(arg, ast.Starred):
                unknown = True
                break
            arguments[parameter] = self._argument(parameter, row.values.get(arg, arg))
        for word in call.keywords:
            if word.arg is None:
                unknown = True
            else:
                arguments[word.arg] = self._argument(
                    word.arg, row.values.get(word.value, word.value)
                )
        attribute, variable = self.target(call)
        func = self._file.method_of(call)
        if func is not None and method not in _CLASSES.values():
            owner = self._file.owner_of(func.value)
        else:
            owner = self._file.owner_of(arguments["node"].node) if "node" in arguments else None
        return Created(
            call,
            self._file.module.location(call),
            owner,
            attribute,
            variable,
            self._file.module.enclosing_function(call),
            arguments,
            unknown,
            not self._is_certain(call, row),
        )

    def _is_certain(self, call: ast.Call, row: Row) -> bool:
        """Return whether a call is executed for a row of the table of its loop, in any case."""
        module, is_conditional = self._file.module, self._file.is_conditional
        for parent in module.parents(call) if row.loop is not None else ():
            if parent is row.loop:
                jumps = module.below(parent, ast.Break, ast.Continue, ast.Return)
                return not any(jumps) and not is_conditional(parent)
            if isinstance(parent, ast.ListComp | ast.DictComp):
                is_plain = parent.generators == [row.loop] and not parent.generators[0].ifs
                return is_plain and not is_conditional(parent)
            if not isinstance(parent, _PLAIN):
                return False
        return not is_conditional(call)

    def _argument(self, name: str, node: ast.expr) -> Argument:
        return Argument(
            name, node, self._file.evaluator.evaluate(node), self._file.module.location(node)
        )

    def target(self, call: ast.Call) -> tuple[str | None, str | None]:
        """Return the attribute of ``self`` and the variable that a call's result is stored in."""
        attribute: str | None = None
        variable: str | None = None
        parent = self._file.module.parent(call)
        targets: Sequence[ast.expr] = ()
        if isinstance(parent, ast.Assign):
            targets = parent.targets
        elif isinstance(parent, ast.AnnAssign | ast.NamedExpr):
            targets = [parent.target]
        for target in targets:
            if isinstance(target, ast.Attribute) and self._file.evaluator.self_class(target.value):
                attribute = target.attr
            elif isinstance(target, ast.Name):
                variable = target.id
        return attribute, variable

    def _callback_argument(self, created: Created, name: str) -> Callback | None:
        argument = created.arguments.get(name)
        return self._file.callback(argument.node) if argument else None

    def _declared(self, created: Created, method: str) -> Iterator[Parameter]:
        for item in self._file.declarations.declarations_in(created.call, method):
            yield self._parameter(created, item)

    def _parameter(self, created: Created, given: Declaration) -> Parameter:
        name, value = given.name, given.value
        is_open = created.has_unknown_arguments
        return Parameter(
            created,
            given,
            name=self._file.declarations.full_name(given.prefix, name),
            name_location=self._file.module.location(name) if name else created.location,
            default=self._file.evaluator.evaluate(value),
            declared_type=self._type_named(value),
            descriptor=None if is_open else descriptor_of(self._file.evaluator, given.descriptor),
        )

    def _type_named(self, node: ast.expr | None) -> str | None:
        name = self._file.module.qualified_name(node) if node else None
        if name and name.startswith("rclpy.") and ".Parameter.Type." in name:
            return name.rpartition(".")[2].lower()
        return None


def _parameters_in(notes: frozenset[str]) -> frozenset[str]:
    return frozenset(note.removeprefix(NOTE) for note in notes if note.startswith(NOTE))
