"""Infers the message type of expressions in rclpy code, where it is certain."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property

from scaffold import lazy_re
from scaffold.model import reads
from scaffold.model.interfaces.definitions import Definitions
from scaffold.model.interfaces.syntax import Field
from scaffold.model.interfaces.types import FieldType
from scaffold.model.messages.actions import ActionMessages
from scaffold.model.messages.classes import MessageClass, class_named
from scaffold.model.messages.expected_errors import is_error_expected
from scaffold.model.messages.files import message_paths
from scaffold.model.messages.passed import Fields, OwnCall, fields_of_parameters, own_calls, passed
from scaffold.model.package import Package
from scaffold.model.python.evaluation.attributes import Store
from scaffold.model.python.evaluation.values import is_none_literal
from scaffold.model.python.scopes import Binding, FunctionNode
from scaffold.model.rclpy.api import PARAMETER, class_of, future_given
from scaffold.model.rclpy.entities import (
    ActionServer,
    Callback,
    Endpoint,
    Service,
    Subscription,
)
from scaffold.model.rclpy.file import RclpyFile, rclpy_file
from scaffold.record import NamedTuple

_PARAMETER_VALUE = "rcl_interfaces.msg.ParameterValue"
_DEPTH = 12
_MAX_BINDINGS = 200  # assignments of one name or attribute; with more its type is unknown
_OF_EVENTS = lazy_re.compile(r"connect$|register(?!Callback)|add_(?:listener|handler|observer)")
"""Matches methods that take a function for the events of another library."""
_ASKS_TYPE = frozenset({"isinstance", "type", "hasattr", "issubclass"})


class Assigned(NamedTuple):
    """A value that is assigned to a field, or passed for it to the constructor."""

    owner: MessageClass
    field: Field
    value: ast.expr
    holder: ast.expr
    """The message of the field: an expression, or the call of its constructor."""


class MessageTypes:
    """The types of the message objects in one Python file."""

    def __init__(self, file: RclpyFile, definitions: Definitions) -> None:
        self.file = file
        self.module = file.module
        self.definitions = definitions
        self._types: dict[object, FieldType | MessageClass | None] = {}
        """The types by expression, or by name and scope."""
        self._classes: dict[ast.expr, MessageClass | None] = {}
        self._depth = 0
        self._reads = reads.current()

    @classmethod
    def of(cls, package: Package, path: str) -> MessageTypes:
        """Return the view of a file; raises ViewError if it cannot be parsed."""

        def build() -> MessageTypes:
            return cls(rclpy_file(package, path), package.workspace.interfaces)

        return package.remember(("message_types", path), build)

    @classmethod
    def of_package(cls, package: Package) -> Iterator[MessageTypes]:
        """Yield the views of all files that import interfaces, except those of ROS 1."""
        for path in message_paths(package):
            yield cls.of(package, path)

    # -- classes

    def class_of(self, node: ast.expr) -> MessageClass | None:
        """Return the message class that an expression names."""
        if node not in self._classes:
            name = self.module.qualified_name(self.file.evaluator.single_value(node))
            self._classes[node] = class_named(self.definitions, name) if name else None
        return self._classes[node]

    def _class_of_type(self, type_: FieldType) -> MessageClass | None:
        interface = self.definitions.find(type_.full_name)
        return MessageClass(interface, interface.sections[0], "") if interface else None

    # -- objects

    def type_of(self, node: ast.expr) -> MessageClass | None:
        """Return the certain message type of an expression."""
        result = self._type(node)
        if isinstance(result, FieldType):
            if result.is_primitive or result.is_array:
                return None
            return self._class_of_type(result)
        return result

    def class_of_field(self, owner: MessageClass, name: str) -> MessageClass | None:
        """Return the class of a field that is one message."""
        field = owner.section.field(name)
        is_message = field is not None and not (field.type.is_primitive or field.type.is_array)
        return self._class_of_type(field.type) if field is not None and is_message else None

    def field_type_of(self, node: ast.expr) -> FieldType | None:
        """Return the type of the field read by an expression, if certain."""
        type_ = self._type(node)
        return type_ if isinstance(type_, FieldType) else None

    def _type(self, node: ast.expr) -> FieldType | MessageClass | None:
        """Return the message type of an expression, or the type of the field it reads."""
        key: object = node
        if isinstance(node, ast.Name):
            key = node.id, self.module.index.scope_of(node)
        if key not in self._types:
            if self._depth > _DEPTH:
                return None
            self._types[key] = None  # ends the recursion of values assigned to themselves
            self._depth += 1
            self._types[key] = self._infer(node)
            self._depth -= 1
        return self._types[key]

    def _infer(self, node: ast.expr) -> FieldType | MessageClass | None:
        match node:
            case ast.Call():
                return self._made(node)
            case ast.Name():
                return self._type_of_name(node)
            case ast.Subscript(value=value, slice=index) if not isinstance(index, ast.Slice):
                return self._element(self._type(value))
            case ast.Attribute():
                return self._type_of_field(node)
        return None

    def _made(self, node: ast.Call) -> MessageClass | None:
        """Return the type of the value of a call."""
        match node.func:
            case ast.Attribute(attr="result", value=future) if not node.args:
                return self._answer(future)
            case ast.Attribute(attr="get_parameter_value", value=parameter):
                is_known = class_of(self.file, parameter) == PARAMETER
                return class_named(self.definitions, _PARAMETER_VALUE) if is_known else None
        return self.class_of(node.func)

    def _answer(self, node: ast.expr) -> MessageClass | None:
        """Return the response type of the future of a service call."""
        future = future_given(self.file, node)
        made = self.file.evaluator.single_value(node if future is None else future)
        match made:
            case ast.Call(func=ast.Attribute(attr="call_async", value=holder)):
                call = self.file.evaluator.single_value(holder)
                for client in self.file.clients:
                    if client.call is call:
                        return self._class_of_endpoint(client, "Response")
        return None

    def _type_of_field(self, node: ast.Attribute) -> FieldType | MessageClass | None:
        owner = self.type_of(node.value)
        if owner is None:
            return self._goal(node) or self._unwrapped(node) or self._type_of_attribute(node)
        field = owner.section.field(node.attr)
        return field.type if field else None

    def _element(self, type_: FieldType | MessageClass | None) -> FieldType | None:
        is_array = isinstance(type_, FieldType) and type_.is_array
        return type_.element if is_array and isinstance(type_, FieldType) else None

    def _type_of_name(self, node: ast.Name) -> FieldType | MessageClass | None:
        lookup = self.module.index.lookup(node.id, node)
        if lookup is None:
            return None
        scope, all_bindings = lookup
        bindings = [binding for binding in all_bindings if binding.kind != "annotation"]
        if len(bindings) > _MAX_BINDINGS or self._is_asked(scope, node.id):
            return None
        types = [self._type_of_binding(binding) for binding in bindings]
        return types[0] if types and all(type_ == types[0] for type_ in types) else None

    def _type_of_binding(self, binding: Binding) -> FieldType | MessageClass | None:
        if binding.kind == "assignment" and binding.value is not None:
            return self._type(binding.value)
        if binding.kind == "parameter":
            return self._parameters.get(binding.node)
        parent = self.module.parent(binding.node)
        if isinstance(parent, ast.For | ast.comprehension) and parent.target is binding.node:
            return self._element(self._type(parent.iter))
        return None

    def _type_of_attribute(self, node: ast.Attribute) -> FieldType | MessageClass | None:
        """Return the type of an attribute of ``self``, if all its assignments agree."""
        evaluator = self.file.evaluator
        class_ = evaluator.self_class(node.value)
        if class_ is None or self._is_asked(class_, node.attr):
            return None
        values = evaluator.attribute_values(node)
        values = [v for v in values or () if not is_none_literal(v)]
        if len(values) > _MAX_BINDINGS:
            return None
        types = [self._type(value) for value in values]
        if not types or types[0] is None or any(type_ != types[0] for type_ in types):
            return None
        return types[0]

    def _goal(self, node: ast.Attribute) -> MessageClass | None:
        """Return the goal for ``goal_handle.request`` in the callback of an action server."""
        if node.attr != "request" or not isinstance(node.value, ast.Name):
            return None
        bound = self.module.index.only_node(node.value)
        return self._goal_handles.get(bound) if bound is not None else None

    @cached_property
    def action_messages(self) -> ActionMessages:
        """The messages received by action clients."""
        return ActionMessages(self.file)

    def _unwrapped(self, node: ast.Attribute) -> MessageClass | None:
        """Return the part of an action for ``message.feedback`` and ``future.result().result``."""
        if node.attr not in {"feedback", "result"}:
            return None
        wrapped = self.action_messages.wrapped(node.value)
        if wrapped is None or wrapped.field != node.attr:
            return None
        return self._class_of_endpoint(wrapped.client, wrapped.part)

    # -- parameters of callbacks

    @cached_property
    def _parameters(self) -> Mapping[ast.AST, MessageClass | None]:
        """The parameters that receive messages; ``None`` if callbacks disagree."""
        result: dict[ast.AST, MessageClass | None] = {}
        for endpoint, callback, index, part in self._passed():
            parameter = self._callback_parameter(callback, index)
            class_ = self._class_of_endpoint(endpoint, part)
            if parameter is not None:
                same = result.get(parameter, class_) == class_
                result[parameter] = class_ if same else None
        return result

    def _passed(self) -> Iterator[tuple[Endpoint, Callback | None, int, str]]:
        """Yield endpoints with callbacks, the index of the parameter and the received section."""
        called = [(endpoint, endpoint.callback) for endpoint in self.file.endpoints]
        for endpoint, callback in (*called, *self.file.inherited_callbacks):
            if isinstance(endpoint, Subscription) and not endpoint.argument("raw"):
                yield endpoint, callback, 0, ""
            elif isinstance(endpoint, Service):
                yield endpoint, callback, 0, "Request"
                yield endpoint, callback, 1, "Response"
        for synchronizer in self.file.synchronizers:
            for index, given in enumerate(synchronizer.inputs or ()):
                if given is not None:
                    yield from ((given, callback, index, "") for callback in synchronizer.callbacks)

    @cached_property
    def _goal_handles(self) -> Mapping[ast.AST, MessageClass | None]:
        result: dict[ast.AST, MessageClass | None] = {}
        for endpoint in self.file.action_servers:
            parameter = self._callback_parameter(endpoint.callback, 0)
            if parameter is not None and isinstance(endpoint, ActionServer):
                class_ = self._class_of_endpoint(endpoint, "Goal")
                same = result.get(parameter, class_) == class_
                result[parameter] = class_ if same else None
        return result

    def _class_of_endpoint(self, endpoint: Endpoint, part: str) -> MessageClass | None:
        if endpoint.interface is None:
            return None
        dotted = endpoint.interface.replace("/", ".")
        return class_named(self.definitions, f"{dotted}.{part}" if part else dotted)

    def _callback_parameter(self, callback: Callback | None, index: int) -> ast.arg | None:
        if callback is None or callback.function is None or callback.is_partial:
            return None
        function = callback.function
        if not isinstance(function, ast.Lambda) and (
            function.decorator_list or self._is_for_others(function.name)
        ):
            return None
        parameters = [*function.args.posonlyargs, *function.args.args]
        index += int(callback.is_bound)
        return parameters[index] if index < len(parameters) else None

    def _is_for_others(self, name: str) -> bool:
        """Return whether a callback is also passed to something that may pass other objects."""
        for use in self.module.index.attributes(name):
            match self.module.parent(use):
                case ast.AugAssign(value=value) if value is use:
                    return True
                case ast.Call(func=ast.Attribute(attr=method) as called) if called is not use:
                    if _OF_EVENTS.match(method):
                        return True
        return False

    def _is_asked(self, scope: ast.AST, name: str) -> bool:
        """Return whether code tests the type of an object, which may then be any."""
        return (scope, name) in self._type_checked_names

    @cached_property
    def _type_checked_names(self) -> frozenset[tuple[ast.AST, str]]:
        result: set[tuple[ast.AST, str]] = set()
        for call in self.module.walk(ast.Call):
            if not _asks_type(call):
                continue
            asked = call.args[0]
            if isinstance(asked, ast.Name):
                bound = self.module.index.lookup(asked.id, asked)
                if bound:
                    result.add((bound[0], asked.id))
            elif isinstance(asked, ast.Attribute):
                class_ = self.file.evaluator.self_class(asked.value)
                if class_:
                    result.add((class_, asked.attr))
        return frozenset(result)

    # -- values of fields

    @cached_property
    def assigned(self) -> Sequence[Assigned]:
        """All values assigned to fields of known messages, in source order."""
        result = [*self._assigned_attributes(), *self._keywords()]
        return sorted(result, key=lambda item: (item.value.lineno, item.value.col_offset))

    @cached_property
    def passed(self) -> Sequence[Assigned]:
        """The arguments that functions of the package assign to fields, unchanged."""
        return [*passed(self)]

    @cached_property
    def own_calls(self) -> Sequence[OwnCall]:
        """The calls of functions of the package."""
        with reads.recorded(self._reads):
            return [*own_calls(self)]

    @cached_property
    def fields_of_parameters(self) -> Mapping[FunctionNode, Fields]:
        """The fields that the functions of the file assign their parameters to."""
        return fields_of_parameters(self)

    def of_file(self, file: RclpyFile) -> MessageTypes | None:
        """Return the view of a file of the same package."""
        if file is self.file:
            return self
        package = self.file.modules
        return MessageTypes.of(package, file.module.path) if isinstance(package, Package) else None

    def _assigned_attributes(self) -> Iterator[Assigned]:
        for store in self._attribute_stores():
            if store.value is None or is_error_expected(self.module, store.node):
                continue
            owner = self.type_of(store.node.value)
            field = owner.section.field(store.node.attr) if owner else None
            if owner and field:
                yield Assigned(owner, field, store.value, store.node.value)

    def _attribute_stores(self) -> Iterator[Store]:
        for name in sorted({node.attr for node in self.module.walk(ast.Attribute)}):
            yield from self.file.evaluator.stores(name)

    def _keywords(self) -> Iterator[Assigned]:
        for call in self.module.walk(ast.Call):
            if not call.keywords or is_error_expected(self.module, call):
                continue
            owner = self.class_of(call.func)
            for word in call.keywords if owner else ():
                field = owner.section.field(word.arg) if owner and word.arg else None
                if owner and field:
                    yield Assigned(owner, field, word.value, call)


def _asks_type(call: ast.Call) -> bool:
    """Return whether a call checks what an object is or has; ``getattr`` does with a default."""
    match call:
        case ast.Call(func=ast.Name(id="getattr"), args=[_, _, _]):
            return True
        case ast.Call(func=ast.Name(id=name), args=[_, *_]):
            return name in _ASKS_TYPE
    return False
