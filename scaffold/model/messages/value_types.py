"""Infers the Python type of an expression, if it is certain."""

from __future__ import annotations

import ast
from collections.abc import Mapping, Sequence

from scaffold.model.interfaces.types import FLOATS, INTEGER_RANGES, TEXTS, FieldType
from scaffold.model.messages.inference import MessageTypes
from scaffold.model.python.evaluation.returns import is_generator, may_end, returned
from scaffold.model.python.evaluation.values import UNKNOWN
from scaffold.model.rclpy.api import class_of

RCLPY_TIMES: Mapping[str | None, str] = {
    "rclpy.time.Time": "builtin_interfaces/msg/Time",
    "rclpy.duration.Duration": "builtin_interfaces/msg/Duration",
}
"""The rclpy classes that ``to_msg()`` converts to messages."""
_CLOCKS = frozenset({"rclpy.clock.Clock", "rclpy.clock.ROSClock"})
_RETURNS: Mapping[str, str] = {
    "bool": "bool",
    "float": "float",
    "input": "str",
    "int": "int",
    "isinstance": "bool",
    "len": "int",
    "ord": "int",
    "repr": "str",
    "str": "str",
    "math.atan2": "float",
    "math.cos": "float",
    "math.radians": "float",
    "math.degrees": "float",
    "math.sin": "float",
    "math.sqrt": "float",
    "math.floor": "int",
    "math.ceil": "int",
    "time.time": "float",
    "math.hypot": "float",
    "numpy.count_nonzero": "int",
    "math.tan": "float",
    "random.gauss": "float",
    "random.randint": "int",
    "random.random": "float",
    "random.uniform": "float",
    "time.monotonic": "float",
    "time.perf_counter": "float",
    "time.time_ns": "int",
    **dict.fromkeys(
        ("cv2.findContours", "cv2.imencode", "cv2.threshold", "divmod", "math.modf"), "results"
    ),
}
_OF_TEXT = {
    **dict.fromkeys(("lower", "upper", "strip", "rstrip", "lstrip", "title", "replace"), "str"),
    **dict.fromkeys(("format", "join", "capitalize", "removeprefix", "removesuffix"), "str"),
    "encode": "bytes",
    "split": "list",
    "splitlines": "list",
}
"""The types returned by string methods."""
_NUMBERS = frozenset({"int", "float"})
_DEPTH = 8


def rclpy_time(types: MessageTypes, node: ast.expr) -> str | None:
    """Return the message type of ``to_msg()`` of an rclpy Time or Duration.

    ``None`` for what is not certainly one: ``builtin_interfaces/msg/Time`` and so on.
    """
    value = types.file.evaluator.single_value(node)
    if not isinstance(value, ast.Call):
        return None
    called = types.module.qualified_name(value.func)
    if called in RCLPY_TIMES:
        return RCLPY_TIMES[called]
    match value.func:
        case ast.Attribute(attr="now", value=clock) if _is_clock(types, clock):
            return RCLPY_TIMES["rclpy.time.Time"]
    return None


def _is_clock(types: MessageTypes, node: ast.expr) -> bool:
    made = types.file.evaluator.single_value(node)
    if not isinstance(made, ast.Call):
        return False
    asked = isinstance(made.func, ast.Attribute) and made.func.attr == "get_clock"
    return asked or types.module.qualified_name(made.func) in _CLOCKS


class ValueTypes:
    """Infers the Python type of an expression, if certain."""

    def __init__(self, types: MessageTypes, depth: int = 0) -> None:
        self._types = types
        self._module = types.module
        self._evaluator = types.file.evaluator
        self._depth = depth

    def of(self, node: ast.expr) -> str | None:
        """Return ``bool``, ``int``, ``float``, ``str`` ...; ``None`` if uncertain."""
        value = self._evaluator.evaluate(node)
        if value is None:
            # None elsewhere means "not assigned yet".
            return "none" if isinstance(node, ast.Constant) else None
        if value is not UNKNOWN:
            return _kind_of_value(value)
        if self._depth > _DEPTH:
            return None
        self._depth += 1
        result = self._of_expression(node)
        self._depth -= 1
        return result

    def _of_expression(self, node: ast.expr) -> str | None:
        kind = _literal_kind(node)
        if kind is None:
            match node:
                case ast.Call():
                    kind = self._of_call(node)
                case ast.UnaryOp(op=ast.USub() | ast.UAdd(), operand=operand):
                    inner = self.of(operand)
                    kind = inner if inner in _NUMBERS else None
                case ast.IfExp():
                    kind = self.common_type([node.body, node.orelse])
                case ast.BinOp():
                    kind = self._of_operation(node)
                case ast.Attribute():
                    kind = self._of_attribute(node)
                case ast.Name():
                    kind = self._of_name(node)
        return kind

    def _of_call(self, node: ast.Call) -> str | None:
        name = self._module.qualified_name(node.func) or ""
        if name in {"abs", "min", "max"} and len(node.args) > (name != "abs") and not node.keywords:
            kind = self.common_type(node.args)
            return kind if kind in _NUMBERS else None
        if name == "round" and len(node.args) == 1:
            return "int" if self.of(node.args[0]) in {None, *_NUMBERS} else None
        match node.func:
            case ast.Attribute(attr=method, value=text) if method in _OF_TEXT:
                return _OF_TEXT[method] if self.of(text) == "str" else None
        return _RETURNS.get(name) or self._of_own(node)

    def _of_own(self, node: ast.Call) -> str | None:
        """Return the type of all results of a function of the package."""
        defined = self._types.file.definition_of(node.func)
        function = defined[1] if defined is not None else None
        other = self._types.of_file(defined[0]) if defined is not None else None
        if other is None or not isinstance(function, ast.FunctionDef) or function.decorator_list:
            return None
        values = [statement.value for statement in returned(function)]
        if None in values or not values or is_generator(function) or may_end(function):
            return None
        kinds = ValueTypes(other, self._depth + 1)
        return kinds.common_type([value for value in values if value is not None])

    def _of_operation(self, node: ast.BinOp) -> str | None:
        left, right = self.of(node.left), self.of(node.right)
        if left == "str" and isinstance(node.op, ast.Mod | ast.Add):
            return "str"
        if left not in _NUMBERS or right not in _NUMBERS:
            return None
        if isinstance(node.op, ast.Div):
            return "float"
        if isinstance(node.op, ast.Add | ast.Sub | ast.Mult | ast.Mod | ast.FloorDiv):
            return "float" if "float" in {left, right} else "int"
        return None

    def _of_name(self, node: ast.Name) -> str | None:
        bindings = [
            item for item in self._module.index.bindings_of(node) if item.kind != "annotation"
        ]
        if bindings and all(self._is_index(item.node) for item in bindings):
            return "int"
        if not bindings or any(b.kind != "assignment" or b.value is None for b in bindings):
            return None
        return self.common_type([b.value for b in bindings if b.value is not None])

    def _is_index(self, target: ast.AST) -> bool:
        """Return whether a loop counts with a variable: by ``range`` or ``enumerate``."""
        function, parent = "range", self._module.parent(target)
        if isinstance(parent, ast.Tuple) and parent.elts[0] is target:
            function, target, parent = "enumerate", parent, self._module.parent(parent)
        match parent:
            case ast.For(iter=ast.Call() as call) | ast.comprehension(iter=ast.Call() as call):
                is_own = self._module.index.lookup(function, call) is not None
                return parent.target is target and ast.unparse(call.func) == function and not is_own
        return False

    def _of_attribute(self, node: ast.Attribute) -> str | None:
        """Return the type of a field, or of an attribute of ``self`` used as a counter."""
        type_ = self._types.field_type_of(node)
        if type_ is not None:
            return kind_of_field(type_) or None
        if node.attr in {"size", "ndim"}:
            made = self._evaluator.single_value(node.value)
            name = self._module.qualified_name(made.func) if isinstance(made, ast.Call) else None
            return "int" if (name or "").startswith("numpy.") else None
        if node.attr == "nanoseconds":
            is_time = class_of(self._types.file, node.value) in RCLPY_TIMES
            return "int" if is_time else None
        class_ = self._evaluator.self_class(node.value)
        if class_ is None:
            return None
        family = self._types.file.related_classes(class_)
        values: list[ast.expr] = []
        for store in self._evaluator.stores(node.attr):
            if store.class_ is not None and store.class_ not in family:
                continue
            above = self._module.parent(store.node)
            if isinstance(above, ast.AugAssign) and isinstance(above.op, ast.Add | ast.Sub):
                values.append(above.value)
            elif store.class_ is None or store.value is None:
                return None
            else:
                values.append(store.value)
        return self.common_type(values)

    def common_type(self, values: Sequence[ast.expr]) -> str | None:
        """Return the type of several values; ``None`` if they differ."""
        kinds = {self.of(value) for value in values}
        return kinds.pop() if len(kinds) == 1 else None


def kind_of_field(type_: FieldType | None) -> str:
    """Return the Python type of a field of a plain type; empty for other fields."""
    if type_ is None or type_.is_array or not type_.is_primitive or type_.name == "byte":
        return ""
    if type_.name in FLOATS:
        return "float"
    if type_.name in TEXTS:
        return "str"
    return "int" if type_.name in INTEGER_RANGES else "bool"


def _literal_kind(node: ast.expr) -> str | None:
    """Return the type of a literal expression."""
    kind = None
    match node:
        case ast.JoinedStr():
            kind = "str"
        case ast.List() | ast.ListComp():
            kind = "list"
        case ast.Dict() | ast.DictComp():
            kind = "dict"
        case ast.Compare(ops=[ast.Is() | ast.IsNot() | ast.In() | ast.NotIn()]):
            kind = "bool"
        case ast.UnaryOp(op=ast.Not()):
            kind = "bool"
    return kind


def _kind_of_value(value: object) -> str | None:
    for type_, kind in (
        (bool, "bool"),
        (int, "int"),
        (float, "float"),
        (str, "str"),
        (bytes, "bytes"),
        (list | tuple, "list"),
        (dict, "dict"),
    ):
        if isinstance(value, type_):
            return kind
    return None
