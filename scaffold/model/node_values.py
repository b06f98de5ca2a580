"""What attributes and parameters of a node are worth, and qualities of service."""

from __future__ import annotations

import ast
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, NamedTuple

from scaffold.model.constants import Evaluator
from scaffold.model.node_entities import Qos
from scaffold.model.values import UNKNOWN, Unknown, is_known, same

if TYPE_CHECKING:
    from scaffold.model.python_module import PythonModule
    from scaffold.model.scopes import FunctionNode
    from scaffold.model.source import Location

PARAMETER_CALLS = frozenset({"get_parameter", "declare_parameter", "get_parameter_or"})
NOTE = "parameter:"
"""In front of a parameter's name, in the notes of a value that is its default."""

_ACCESSORS: Mapping[str, type] = {
    "double_value": float,
    "integer_value": int,
    "string_value": str,
    "bool_value": bool,
    "double_array_value": list,
    "integer_array_value": list,
    "string_array_value": list,
    "bool_array_value": list,
}

_PROFILES: Mapping[str, tuple[int, str, str, str]] = {
    "default": (10, "KEEP_LAST", "RELIABLE", "VOLATILE"),
    "sensor_data": (5, "KEEP_LAST", "BEST_EFFORT", "VOLATILE"),
    "services_default": (10, "KEEP_LAST", "RELIABLE", "VOLATILE"),
    "parameters": (1000, "KEEP_LAST", "RELIABLE", "VOLATILE"),
    "parameter_events": (1000, "KEEP_LAST", "RELIABLE", "VOLATILE"),
    "action_status_default": (1, "KEEP_LAST", "RELIABLE", "TRANSIENT_LOCAL"),
    "best_available": (10, "KEEP_LAST", "BEST_AVAILABLE", "BEST_AVAILABLE"),
    "system_default": (0, "SYSTEM_DEFAULT", "SYSTEM_DEFAULT", "SYSTEM_DEFAULT"),
}
"""Depth, history, reliability and durability of the predefined profiles of rclpy 7.1."""

_QOS_PARAMETERS = ("history", "depth", "reliability", "durability")


class Store(NamedTuple):
    """One place where an attribute gets a value."""

    node: ast.Attribute
    class_: ast.ClassDef | None
    """The class whose ``self`` it is an attribute of."""
    value: ast.expr | None


class NodeEvaluator(Evaluator):
    """Knows attributes of ``self`` that are assigned once, and defaults of parameters."""

    def __init__(
        self,
        module: PythonModule,
        default_of: Callable[[ast.expr, str], object],
        related: Callable[[ast.ClassDef], Sequence[ast.ClassDef]],
    ) -> None:
        super().__init__(module)
        self._default_of = default_of
        self._related = related
        self._stores: dict[str, list[Store]] | None = None

    # -- self

    def self_class(self, node: ast.expr) -> ast.ClassDef | None:
        """Return the class whose instance a name such as ``self`` is."""
        if not isinstance(node, ast.Name):
            return None
        found = self.module.index.lookup(node.id, node)
        if found is None or [binding.kind for binding in found[1]] != ["parameter"]:
            return None
        function, parameter = found[0], found[1][0].node
        class_ = self.module.parent(function)
        if not isinstance(function, ast.FunctionDef | ast.AsyncFunctionDef):
            return None
        if not isinstance(class_, ast.ClassDef) or _is_static(function):
            return None
        first = [*function.args.posonlyargs, *function.args.args][:1]
        return class_ if first == [parameter] else None

    def stores(self, name: str) -> Sequence[Store]:
        """Return the places where an attribute of this name gets a value, on any object."""
        if self._stores is None:
            self._stores = {}
            for node in self.module.walk(ast.Attribute):
                if not isinstance(node.ctx, ast.Load):
                    store = Store(node, self.self_class(node.value), self._stored(node))
                    self._stores.setdefault(node.attr, []).append(store)
        return self._stores.get(name, ())

    def _stored(self, node: ast.Attribute) -> ast.expr | None:
        parent = self.module.parent(node)
        match parent:
            case ast.Assign() | ast.AnnAssign() | ast.NamedExpr():
                return parent.value
            case ast.Tuple() | ast.List():
                above = self.module.parent(parent)
                values = above.value if isinstance(above, ast.Assign) else None
                if isinstance(values, ast.Tuple) and len(values.elts) == len(parent.elts):
                    return values.elts[parent.elts.index(node)]
        return None

    def attribute_values(self, node: ast.Attribute) -> Sequence[ast.expr] | None:
        """Return all expressions that ``self.name`` may be worth; ``None`` if more is possible."""
        class_ = self.self_class(node.value) or self._named_class(node.value)
        if class_ is None:
            return None
        family = self._related(class_)
        values: list[ast.expr] = []
        for store in self.stores(node.attr):
            if store.class_ is not None and store.class_ not in family:
                continue
            if store.class_ is None or store.value is None:
                return None
            values.append(store.value)
        for member in family:
            for binding in self.module.index.bindings(member).get(node.attr, ()):
                if binding.kind == "annotation":
                    continue
                if binding.value is None:
                    return None
                values.append(binding.value)
        return values

    def _named_class(self, node: ast.expr) -> ast.ClassDef | None:
        if isinstance(node, ast.Name):
            found = self.module.index.lookup(node.id, node)
            if found and len(found[1]) == 1 and isinstance(found[1][0].node, ast.ClassDef):
                return found[1][0].node
        return None

    def single_value(self, node: ast.expr) -> ast.expr:
        """Follow names and attributes of ``self`` with one assignment to what is assigned."""
        for _ in range(10):
            values: Sequence[ast.expr | None] | None = None
            if isinstance(node, ast.Name):
                found = self.module.index.lookup(node.id, node)
                values = [
                    binding.value
                    for binding in (found[1] if found else ())
                    if binding.kind != "annotation"
                ]
            elif isinstance(node, ast.Attribute):
                values = self.attribute_values(node)
            if not values or len(values) != 1 or values[0] is None:
                return node
            node = values[0]
        return node

    # -- call sites

    def argument(self, node: ast.arg) -> object:
        """Return what all calls of a constructor or private function in the file agree on."""
        function = self.module.parent(self.module.parent(node) or node)
        if not isinstance(function, ast.FunctionDef | ast.AsyncFunctionDef):
            return UNKNOWN
        calls = self._call_sites(function)
        if not calls:
            return UNKNOWN
        is_method = isinstance(self.module.parent(function), ast.ClassDef)
        given = [given_argument(function, call, node, is_method=is_method) for call in calls]
        return self._common([value and self.evaluate(value) for value in given])

    def _common(self, values: Sequence[object]) -> object:
        """Return the value that all values are."""
        if any(not _is_sure(value) or not same(value, values[0]) for value in values):
            return UNKNOWN
        return values[0] if values else UNKNOWN

    def _call_sites(self, function: FunctionNode) -> Sequence[ast.Call] | None:
        """Return all calls of a function; ``None`` if there may be others."""
        class_ = self.module.parent(function)
        if not isinstance(class_, ast.ClassDef):
            is_nested = self.module.enclosing_function(function) is not None
            return self._calls_by_name(function) if is_nested or _is_private(function) else None
        if function.name == "__init__":
            return self._constructions(class_, [])
        return self._method_calls(function, class_) if _is_private(function) else None

    def _calls_by_name(self, node: FunctionNode | ast.ClassDef) -> list[ast.Call] | None:
        calls: list[ast.Call] = []
        for name in self.module.walk(ast.Name):
            if name.id != node.name or not isinstance(name.ctx, ast.Load):
                continue
            found = self.module.index.lookup(name.id, name)
            if found is None or all(binding.node is not node for binding in found[1]):
                continue
            parent = self.module.parent(name)
            if isinstance(parent, ast.Call) and parent.func is name and len(found[1]) == 1:
                calls.append(parent)
            elif not isinstance(node, ast.ClassDef) or not self._is_mention(name, parent):
                return None
        return calls

    def _is_mention(self, name: ast.Name, parent: ast.AST | None) -> bool:
        """Tell whether a class is only named: as a base, in an annotation, for a constant."""
        if isinstance(parent, ast.ClassDef | ast.arg | ast.AnnAssign | ast.Attribute):
            return True
        if isinstance(parent, ast.FunctionDef | ast.AsyncFunctionDef):
            return parent.returns is name
        return isinstance(parent, ast.Call) and (
            self.module.qualified_name(parent.func) in {"isinstance", "super", "issubclass"}
        )

    def _constructions(
        self, class_: ast.ClassDef, seen: list[ast.ClassDef]
    ) -> list[ast.Call] | None:
        """Return the calls that end in a class's constructor, from subclasses too."""
        seen.append(class_)
        calls = self._calls_by_name(class_)
        for other in self.module.walk(ast.ClassDef):
            if calls is None:
                return None
            if other in seen or class_ not in map(self._named_class, other.bases):
                continue
            constructors = [
                node
                for binding in self.module.index.bindings(other).get("__init__", ())
                if isinstance(node := binding.node, ast.FunctionDef)
            ]
            if constructors:
                calls.extend(self._super_calls(constructors[-1]))
            else:
                calls.extend(self._constructions(other, seen) or ())
        return calls

    def _super_calls(self, constructor: ast.FunctionDef) -> Iterator[ast.Call]:
        for call in self.module.walk(ast.Call):
            match call.func:
                case ast.Attribute(attr="__init__", value=ast.Call(func=ast.Name(id="super"))):
                    if self.module.enclosing_function(call) is constructor:
                        yield call

    def _method_calls(self, function: FunctionNode, class_: ast.ClassDef) -> list[ast.Call] | None:
        calls: list[ast.Call] = []
        family = self._related(class_)
        for node in self.module.walk(ast.Attribute):
            if node.attr != function.name:
                continue
            holder = self.self_class(node.value)
            if holder is not None and holder not in family:
                continue
            parent = self.module.parent(node)
            if holder is None or not isinstance(parent, ast.Call) or parent.func is not node:
                return None
            calls.append(parent)
        return calls

    # -- hooks

    def attribute(self, node: ast.Attribute) -> object:
        """Return the value of an attribute of ``self`` or of a parameter."""
        if node.attr == "value":
            return self._parameter(node.value)
        if node.attr in _ACCESSORS:
            return self._parameter_field(node, _ACCESSORS[node.attr])
        found = self.attribute_values(node)
        if not found:
            return UNKNOWN
        value = self._common([self.evaluate(value) for value in found])
        # Nobody follows what methods do to a list that belongs to an object.
        return UNKNOWN if isinstance(value, list | dict) else value

    def _parameter(self, node: ast.expr) -> object:
        """Return the default of the parameter that an expression such as a call reads."""
        call = self.single_value(node)
        if not isinstance(call, ast.Call) or not isinstance(call.func, ast.Attribute):
            return UNKNOWN
        if call.func.attr not in PARAMETER_CALLS:
            return UNKNOWN
        named = [*call.args, *(word.value for word in call.keywords if word.arg == "name")]
        name = self.text(named[0]) if named else UNKNOWN
        if name is UNKNOWN:
            return UNKNOWN
        value = self._default_of(call.func.value, name)
        if value is None or not is_known(value):
            return UNKNOWN
        self.note(NOTE + name)
        return value

    def _parameter_field(self, node: ast.Attribute, kind: type) -> object:
        call = self.single_value(node.value)
        match call:
            case ast.Call(func=ast.Attribute(attr="get_parameter_value", value=parameter)):
                value = self._parameter(parameter)
                return value if type(value) is kind else UNKNOWN
            case _:
                return UNKNOWN

    # -- quality of service

    def qos(self, node: ast.expr) -> Qos:
        """Return the quality of service that an expression stands for."""
        at = self.module.location(node)
        found = self._qos_of(self.single_value(node), at)
        return self._with_later_changes(found, node)

    def _qos_of(self, node: ast.expr, at: Location) -> Qos:
        value = self.evaluate(node)
        if type(value) is int:
            return Qos(at, None, value, *_PROFILES["default"][1:])
        name = self.module.qualified_name(node) or ""
        profile = ""
        if name.startswith("rclpy.qos.qos_profile_"):
            profile = name.removeprefix("rclpy.qos.qos_profile_")
        elif name.startswith("rclpy.qos.QoSPresetProfiles.") and name.endswith(".value"):
            profile = name.split(".")[3].lower()
        elif isinstance(node, ast.Call):
            called = self.module.qualified_name(node.func)
            if called == "rclpy.qos.QoSPresetProfiles.get_from_short_key" and node.args:
                profile = str(self.evaluate(node.args[0])).lower()
            elif called == "rclpy.qos.QoSProfile":
                return self._constructed(node, at)
        return Qos(at, profile, *_PROFILES[profile]) if profile in _PROFILES else Qos(at)

    def _constructed(self, node: ast.Call, at: Location) -> Qos:
        given: dict[str, ast.expr] = dict(zip(_QOS_PARAMETERS, node.args, strict=False))
        for word in node.keywords:
            if word.arg is None:
                return Qos(at)
            given[word.arg] = word.value
        if any(isinstance(arg, ast.Starred) for arg in node.args):
            return Qos(at)
        history = self._policy(given.get("history"), "KEEP_LAST")
        depth: int | Unknown | None
        if "depth" in given:
            value = self.evaluate(given["depth"])
            depth = value if type(value) is int else UNKNOWN
        else:
            depth = None if history == "KEEP_LAST" else UNKNOWN if history is UNKNOWN else 10
        return Qos(
            at,
            None,
            depth,
            history,
            self._policy(given.get("reliability"), "RELIABLE"),
            self._policy(given.get("durability"), "VOLATILE"),
        )

    def _policy(self, node: ast.expr | None, default: str) -> str | Unknown:
        """Return the policy's name: ``TRANSIENT_LOCAL``, in whichever spelling."""
        if node is None:
            return default
        name = self.module.qualified_name(self.single_value(node)) or ""
        if not name.startswith("rclpy.qos."):
            return UNKNOWN
        policy = name.rpartition(".")[2]
        for prefix in ("HISTORY_", "RELIABILITY_", "DURABILITY_"):
            policy = policy.partition(prefix)[2] or policy
        return policy.upper()

    def _with_later_changes(self, found: Qos, node: ast.expr) -> Qos:
        """Apply ``qos.depth = 5`` before the use; what may or may not happen is not known."""
        if not isinstance(node, ast.Name | ast.Attribute):
            return found
        for name in _QOS_PARAMETERS:
            for store in self.stores(name):
                order = self._order(store.node, node)
                if order != "after" and self._is_same_object(store.node.value, node):
                    value = store.value if order == "before" else None
                    found = self._changed(found, name, value)
        return found

    def _changed(self, found: Qos, name: str, value: ast.expr | None) -> Qos:
        """Return a quality of service with one field set; ``None`` for nobody knows what."""
        if name == "depth":
            depth = self.evaluate(value)
            return found._replace(profile=None, depth=depth if type(depth) is int else UNKNOWN)
        policy = UNKNOWN if value is None else self._policy(value, "")
        if name == "history":
            return found._replace(profile=None, history=policy)
        if name == "reliability":
            return found._replace(profile=None, reliability=policy)
        return found._replace(profile=None, durability=policy)

    def _is_same_object(self, first: ast.expr, second: ast.expr) -> bool:
        if isinstance(first, ast.Name) and isinstance(second, ast.Name):
            lookup = self.module.index.lookup
            scopes = [found[0] for n in (first, second) if (found := lookup(n.id, n))]
            return first.id == second.id and len({*scopes}) <= 1
        return self.module.text(first) == self.module.text(second)

    def _order(self, change: ast.AST, use: ast.AST) -> str:
        """Return whether a statement is surely run ``before`` or ``after`` a use, else ``""``."""
        function = self.module.enclosing_function(change)
        if function is not self.module.enclosing_function(use):
            return ""
        around = {function, self.module.tree, *self.module.parents(use)}
        block = self.module.parent(self._statement_of(change))
        loops = ast.For | ast.While | ast.AsyncFor
        if block not in around or isinstance(block, loops | ast.If | ast.Try):
            return ""
        if getattr(change, "lineno", 0) < getattr(use, "lineno", 0):
            return "before"
        return "" if any(isinstance(parent, loops) for parent in around) else "after"

    def _statement_of(self, node: ast.AST) -> ast.AST:
        for parent in (node, *self.module.parents(node)):
            if isinstance(parent, ast.stmt):
                return parent
        return node


def _is_static(function: ast.FunctionDef | ast.AsyncFunctionDef) -> bool:
    return any(
        isinstance(decorator, ast.Name) and decorator.id in {"staticmethod", "classmethod"}
        for decorator in function.decorator_list
    )


def _is_private(function: FunctionNode) -> bool:
    return function.name.startswith("_") and not function.decorator_list


def _is_sure(value: object) -> bool:
    return value is not UNKNOWN


def given_argument(
    function: FunctionNode, call: ast.Call, parameter: ast.arg, *, is_method: bool
) -> ast.expr | None:
    """Return the expression that a parameter gets in a call, its default if it is not given.

    ``None`` if that cannot be told: ``*args``, ``**kwargs``, a variadic parameter.
    """
    signature = function.args
    positional = [*signature.posonlyargs, *signature.args]
    if parameter not in positional and parameter not in signature.kwonlyargs:
        return None
    if any(word.arg is None for word in call.keywords):
        return None
    for word in call.keywords:
        if word.arg == parameter.arg:
            return word.value
    if parameter in positional:
        position = positional.index(parameter) - is_method
        if any(isinstance(arg, ast.Starred) for arg in call.args[: position + 1]):
            return None
        if 0 <= position < len(call.args):
            return call.args[position]
    defaults: dict[ast.arg, ast.expr | None] = dict(
        zip(reversed(positional), reversed(signature.defaults), strict=False)
    )
    defaults.update(zip(signature.kwonlyargs, signature.kw_defaults, strict=True))
    return defaults.get(parameter)
