"""Whether a value fits the type of the message field that it is assigned to."""

from __future__ import annotations

import ast
from collections.abc import Sequence

from scaffold.distributions import target
from scaffold.model.interfaces.types import FLOATS, INTEGER_RANGES, TEXTS, FieldType
from scaffold.model.messages.inference import Assigned, MessageTypes
from scaffold.model.messages.numpy_values import numpy_class
from scaffold.model.messages.value_types import ValueTypes, rclpy_time
from scaffold.model.python.evaluation.literals import joined_names
from scaffold.model.python.evaluation.returns import returned
from scaffold.model.rclpy.api import PARAMETER, class_of, is_method
from scaffold.model.rclpy.evaluation.evaluator import NOTE

_NAMES = {
    "bool": "a bool",
    "bytes": "bytes",
    "dict": "a dict",
    "float": "a float",
    "int": "an int",
    "list": "a list",
    "none": "None",
    "results": "a tuple of several results",
    "str": "a str",
}
_SMALL = frozenset({"int8", "uint8", "byte", "char", "int16", "uint16"})
_SENDING = ("publish", "broadcast", "call(", "call_async(", "send_goal", "serialize")
"""The methods that send a message, or convert it like one that is sent."""
_SHOWN = 30
_NOW = 1.7e18
"""The range of current times in nanoseconds since 1970."""


class TypeMismatches:
    """Finds values that do not fit their fields."""

    def __init__(self, types: MessageTypes) -> None:
        self._types = types
        self._kinds = ValueTypes(types)

    def misfit(self, item: Assigned) -> str | None:
        """Describe a value that its field rejects; ``None`` if it may be valid."""
        type_, node = item.field.type, item.value
        if not type_.is_array:
            return self._single(type_, node)
        given = self._types.type_of(node)
        if given is not None:
            return f"{self._shown(node)} is one {given.name}, not a list"
        kind = self._kinds.of(node)
        if kind in {"int", "float", "bool", "none", "dict", "results"}:
            return f"{self._shown(node)} is {_NAMES[kind]}, not a list"
        if kind == "str" and type_.name != "byte":
            return f"{self._shown(node)} is a str, not a list"
        if kind != "list":
            return self._length(type_, self._returned(node)) or self._table(node)
        problem = self._length(type_, node) or self._elements(type_.element, node)
        return problem or self._joined(type_, node)

    def is_alike(self, item: Assigned) -> bool:
        """Return whether a message is given instead of another one with the same fields."""
        given = self._types.type_of(item.value)
        expected = self._types.definitions.find(item.field.type.full_name)
        if given is None or expected is None or item.field.type.is_array:
            return False
        fields = [(field.name, str(field.type)) for field in expected.sections[0].fields]
        return fields == [(field.name, str(field.type)) for field in given.section.fields]

    def is_harmless_int(self, item: Assigned) -> bool:
        """Return whether a float field gets the int 0, which is sent as zero, or is never sent.

        A test that calls no method to send messages only passes them to functions.
        """
        if not target().fact("messages.has_check_fields"):
            return False  # setters always check values
        value = self._types.file.evaluator.evaluate(item.value)
        if item.field.type.name not in {"float32", "float64"} or type(value) is not int:
            return False
        module = self._types.module
        return value == 0 or (module.in_tests and not module.mentions(*_SENDING))

    def is_unreachable(self, item: Assigned) -> bool:
        """Return whether a value is only assigned if a message field is ``None``."""
        inner: ast.AST = item.value
        for node in self._types.module.parents(item.value):
            match node:
                case ast.If(
                    test=ast.Compare(
                        left=left, ops=[ast.Is()], comparators=[ast.Constant(value=None)]
                    )
                ) if inner in node.body and self._is_field(node, left):
                    return True
                case ast.FunctionDef() | ast.AsyncFunctionDef():
                    return False
            inner = node
        return False

    def _is_field(self, condition: ast.If, node: ast.expr) -> bool:
        """Return whether an expression is a message field, which is never ``None``."""
        if isinstance(node, ast.Name):
            attribute = self._assigned_before(condition, node.id)
            return attribute is not None and self._is_field(condition, attribute)
        is_of_message = (
            isinstance(node, ast.Attribute) and self._types.type_of(node.value) is not None
        )
        return is_of_message and self._types.type_of(node) is not None

    def _assigned_before(self, condition: ast.If, name: str) -> ast.Attribute | None:
        """Return the attribute assigned to a name right before a condition."""
        body = getattr(self._types.module.parent(condition), "body", [])
        place = body.index(condition) if condition in body else 0
        match body[place - 1 : place]:
            case [ast.Assign(targets=[ast.Name(id=target)], value=ast.Attribute() as value)]:
                return value if target == name else None
        return None

    def _table(self, node: ast.expr) -> str | None:
        """Report a two-dimensional numpy array, where rosidl reads beyond the first row."""
        value = self._types.file.evaluator.single_value(node)
        if not isinstance(value, ast.Call) or not value.args:
            return None
        name = self._types.module.qualified_name(value.func) or ""
        first = self._types.file.evaluator.evaluate(value.args[0])
        is_table = False
        if name in {"numpy.eye", "numpy.identity"}:
            is_table = True
        elif name in {"numpy.zeros", "numpy.ones", "numpy.empty", "numpy.full"}:
            is_table = isinstance(first, tuple | list) and len(first) > 1
        elif name == "numpy.array" and isinstance(first, tuple | list):
            is_table = any(isinstance(item, tuple | list) for item in first)
        return f"{self._shown(node)} is two-dimensional; append .flatten()" if is_table else None

    def _length(self, type_: FieldType, node: ast.expr) -> str | None:
        value, notes = self._types.file.evaluator.trace(node)
        size = type_.array_size
        if isinstance(node, ast.List | ast.Tuple):
            is_open = any(isinstance(item, ast.Starred) for item in node.elts)
            value = None if is_open else node.elts
        if size is None or not isinstance(value, list | tuple):
            return None
        if any(note.startswith(NOTE) for note in notes):
            return None  # the parameter also sets the length
        count = len(value)
        if count > size or (count < size and not type_.is_upper_bound):
            most = "at most " if type_.is_upper_bound else ""
            return f"{self._shown(node)} has {count} elements, not {most}{size}"
        return None

    def _returned(self, node: ast.expr) -> ast.expr:
        """Return the only result of a function or method that an expression calls, or itself."""
        called = self._types.file.callback(node.func) if isinstance(node, ast.Call) else None
        function = called.function if called is not None else None
        if not isinstance(function, ast.FunctionDef) or function.decorator_list:
            return node
        results = [statement.value for statement in returned(function)]
        return results[0] if len(results) == 1 and results[0] is not None else node

    def _elements(self, type_: FieldType, node: ast.expr) -> str | None:
        parts: Sequence[ast.expr]
        if isinstance(node, ast.ListComp):
            parts = [node.elt]
        elif isinstance(node, ast.List | ast.Tuple):
            parts = node.elts
        else:
            return None
        for part in parts:
            # rosidl converts the ints of a list of floats.
            if type_.name in FLOATS and self._kinds.of(part) in {"int", "bool"}:
                continue
            wrong = None if isinstance(part, ast.Starred) else self._single(type_, part)
            if wrong:
                return f"element {wrong}"
        return None

    def _joined(self, type_: FieldType, node: ast.expr) -> str | None:
        """Report two names of a list joined by a missing comma."""
        listed = self._types.file.evaluator.single_value(node)
        if type_.name not in TEXTS or not isinstance(listed, ast.List | ast.Tuple):
            return None
        for part in listed.elts:
            names = joined_names(self._types.module, part)
            if names:
                return f"{names[0]!r} and {names[1]!r} are one text: missing comma"
        return None

    def _single(self, type_: FieldType, node: ast.expr) -> str | None:
        given = self._types.type_of(node)
        if given is not None:
            fits = given.name == type_.full_name
            return None if fits else f"{self._shown(node)} is a {given.name}"
        if not type_.is_primitive:
            return self._instead_of_message(node)
        kind = self._kinds.of(node)
        if kind is None:
            return self._object_of_numpy(type_, node) or self._object_of_rclpy(node)
        if kind not in _accepted(type_.name):
            return f"{self._shown(node)} is {_NAMES[kind]}"
        value = self._types.file.evaluator.evaluate(node)
        bound = type_.text_bound
        if bound is not None and isinstance(value, str) and len(value) > bound:
            return f"{self._shown(node)} has {len(value)} characters, not {bound}"
        return self._out_of_range(type_, node, value)

    def _object_of_numpy(self, type_: FieldType, node: ast.expr) -> str | None:
        """Report a number or bool of numpy that is no Python object."""
        python, class_ = numpy_class(self._types, node) or ("", "")
        if python != ("float" if type_.name in FLOATS else type_.name):
            return None
        return f"{self._shown(node)} is a {class_}, not a {python}; write {python}(...)"

    def _object_of_rclpy(self, node: ast.expr) -> str | None:
        """Report an rclpy object, or a method of it that is not called."""
        file = self._types.file
        if isinstance(node, ast.Attribute):
            owner = class_of(file, node.value)
            if owner is not None and is_method(owner, node.attr):
                return f"{node.attr!r} is a method that is not called; write {node.attr}()"
        class_ = class_of(file, node) if isinstance(node, ast.Call) else None
        if class_ == PARAMETER:
            return f"{self._shown(node)} is a Parameter; append .value"
        return None

    def _instead_of_message(self, node: ast.expr) -> str | None:
        if rclpy_time(self._types, node):
            return None  # which has its own rule
        kind = self._kinds.of(node)
        shown = f"{self._shown(node)} is {_NAMES[kind]}" if kind else None
        return shown or self._object_of_rclpy(node)

    def _out_of_range(self, type_: FieldType, node: ast.expr, value: object) -> str | None:
        if type_.name not in INTEGER_RANGES:
            return None
        lowest, highest = INTEGER_RANGES[type_.name]
        held = f"{type_.name} holds {lowest} to {highest}"
        if isinstance(value, int):
            return None if lowest <= value <= highest else f"{value} is out of range: {held}"
        if self._is_epoch(node) and highest < _NOW:
            return f"{self._shown(node)} is about {_NOW:.0e}: {held}"
        counter = self._endless_counter(node) if type_.name in _SMALL else None
        if counter is not None:
            at = self._types.module.location(counter)
            name = self._types.module.text(counter)
            return f"{name} grows without bound in line {at.line}: {held}"
        return None

    def _is_epoch(self, node: ast.expr) -> bool:
        """Return whether a number is a current time in nanoseconds since 1970."""
        match self._types.file.evaluator.single_value(node):
            case ast.Attribute(attr="nanoseconds", value=ast.Call(func=ast.Attribute(attr="now"))):
                return True
        return False

    def _endless_counter(self, node: ast.expr) -> ast.expr | None:
        """Return the attribute in a sum that is incremented forever, and never compared."""
        for part in _summands(node):
            if isinstance(part, ast.Attribute) and self._counts_up(part):
                return self._counting(part)
        return None

    def _counting(self, node: ast.Attribute) -> ast.expr:
        for store in self._types.file.evaluator.stores(node.attr):
            if isinstance(self._types.module.parent(store.node), ast.AugAssign):
                return store.node
        return node

    def _counts_up(self, node: ast.Attribute) -> bool:
        evaluator, module = self._types.file.evaluator, self._types.module
        class_ = evaluator.self_class(node.value)
        if class_ is None:
            return False
        family = self._types.file.related_classes(class_)
        counted = False
        for store in evaluator.stores(node.attr):
            if store.class_ is not None and store.class_ not in family:
                continue
            above = module.parent(store.node)
            if isinstance(above, ast.AugAssign):
                step = evaluator.evaluate(above.value)
                if not (isinstance(above.op, ast.Add) and isinstance(step, int) and step > 0):
                    return False
                counted = counted or self._runs_again(store.node)
            elif store.value is None or not self._is_start(store.node, store.value):
                return False
        return counted and not self._is_watched(node.attr)

    def _runs_again(self, node: ast.AST) -> bool:
        """Return whether a loop or the executor runs code repeatedly, other than on user input."""
        module, file = self._types.module, self._types.file
        if any(isinstance(parent, ast.While) for parent in module.parents(node)):
            return True
        function = file.function_of(node)
        return any(
            callback.function is not None and function in file.reached(callback.function)
            for _, callback in file.callbacks
        )

    def _is_start(self, target: ast.AST, value: ast.expr) -> bool:
        """Return whether an assignment is in ``__init__``, where it resets nothing."""
        function = self._types.module.enclosing_function(target)
        is_int = isinstance(self._types.file.evaluator.evaluate(value), int)
        return is_int and function is not None and function.name == "__init__"

    def _is_watched(self, name: str) -> bool:
        """Return whether an attribute is compared anywhere, which may limit the count."""
        for compare in self._types.module.walk(ast.Compare):
            for part in ast.walk(compare):
                if isinstance(part, ast.Attribute) and part.attr == name:
                    return True
        return False

    def _shown(self, node: ast.expr) -> str:
        text = " ".join(self._types.module.text(node).split())
        return text if len(text) <= _SHOWN else f"{text[: _SHOWN - 3]}..."


def _summands(node: ast.expr) -> list[ast.expr]:
    if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Add):
        return [*_summands(node.left), *_summands(node.right)]
    return [node]


def _accepted(type_name: str) -> frozenset[str]:
    """Return the kinds of Python values that a field of a primitive type takes."""
    if type_name == "bool":
        return frozenset({"bool"})
    if type_name == "byte":
        return frozenset({"bytes"})
    if type_name in FLOATS:
        return frozenset({"float"})
    if type_name in TEXTS:
        return frozenset({"str"})
    return frozenset({"int", "bool"})
