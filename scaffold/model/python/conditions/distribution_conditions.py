"""Evaluates conditions on the distribution: true, false or unknown on the target."""

from __future__ import annotations

import ast
import operator
from collections.abc import Callable, Iterator, Mapping
from contextlib import suppress
from typing import TYPE_CHECKING, Any

from scaffold.distributions import VARIABLE, target
from scaffold.model.python.conditions.running_version import SWAPPED, RunningVersion
from scaffold.model.python.evaluation.evaluator import Evaluator
from scaffold.model.python.evaluation.values import COMPARISONS, UNKNOWN, is_known

if TYPE_CHECKING:
    from scaffold.model.python.syntax_tree import SyntaxTree

_GETTER = "os.getenv"
_SUBSTITUTION = "launch.substitutions.EnvironmentVariable"
_ORDERS: Mapping[type[ast.cmpop], Callable[[Any, Any], bool]] = {
    ast.Lt: operator.lt,
    ast.LtE: operator.le,
    ast.Gt: operator.gt,
    ast.GtE: operator.ge,
}
_ROS_VERSION = "ROS_VERSION"
_OF_ENVIRONMENT = (VARIABLE, _ROS_VERSION)
ASKED = (*_OF_ENVIRONMENT, "ros_version", "version_info", "hexversion")
"""Words in files that test the distribution or its Python version."""
_MAX_DEPTH = 20
"""The maximum number of names to follow in a condition."""


def holds(
    module: SyntaxTree, test: ast.expr, depth: int = 0, *, is_specific: bool = False
) -> bool | None:
    """Return whether a condition is true on the target; ``None`` if unknown.

    Args:
        module: The file.
        test: The condition.
        depth: The number of names followed so far.
        is_specific: Whether it certainly depends on the distribution.
    """
    if not is_specific and not module.mentions(*ASKED):
        return None
    match test:
        case ast.UnaryOp(op=ast.Not(), operand=operand):
            inner = holds(module, operand, depth, is_specific=is_specific)
            return None if inner is None else not inner
        case ast.BoolOp(op=op, values=values):
            deciding = isinstance(op, ast.Or)
            parts = {holds(module, value, depth, is_specific=is_specific) for value in values}
            if deciding in parts:
                return deciding
            return None if None in parts else not deciding
    value, notes = _DistributionEvaluator(module).trace(test)
    if (is_specific or notes) and is_known(value):
        return bool(value)
    named = _only_value(module, test) if depth < _MAX_DEPTH else None
    return None if named is None else holds(module, named, depth + 1, is_specific=is_specific)


def open_parts(module: SyntaxTree, test: ast.expr, depth: int = 0) -> Iterator[ast.expr]:
    """Yield the parts of a condition that are unknown on the target.

    For ``is_old_distro and self.ready`` that is ``self.ready`` on an old one, else nothing.

    Args:
        module: The file.
        test: The condition.
        depth: The number of names followed so far.
    """
    if holds(module, test) is not None:
        return
    parts: list[ast.expr] = []
    match test:
        case ast.UnaryOp(op=ast.Not(), operand=operand):
            parts = [operand]
        case ast.BoolOp(values=values):
            parts = values
        case ast.Name():
            named = _only_value(module, test) if depth < _MAX_DEPTH else None
            if isinstance(named, ast.BoolOp | ast.UnaryOp | ast.Name) and asks(module, named):
                parts = [named]
    for part in parts:
        yield from open_parts(module, part, depth + 1)
    if not parts:
        yield test


def asks(module: SyntaxTree, value: ast.expr) -> bool:
    """Return whether the value of an expression depends on the distribution."""
    if not module.mentions(*ASKED):
        return False
    evaluator = _DistributionEvaluator(module)
    nodes = (node for node in ast.walk(value) if isinstance(node, ast.expr))
    return any(evaluator.trace(node)[1] for node in nodes)


def text_on_target(module: SyntaxTree, value: ast.expr) -> str | None:
    """Return the string value of an expression on the target; ``None`` if independent of it."""
    text, notes = _DistributionEvaluator(module).trace(value)
    return text if notes and isinstance(text, str) else None


def value_on_target(module: SyntaxTree, value: ast.expr) -> tuple[object, bool]:
    """Return an expression's value on the target, and whether it depends on the distribution."""
    result, notes = _DistributionEvaluator(module).trace(value)
    return result, bool(notes)


def _only_value(module: SyntaxTree, test: ast.expr) -> ast.expr | None:
    """Return the value of a name that is set once."""
    match module.index.bindings_of(test):
        case [binding] if binding.kind == "assignment":
            return binding.value
    return None


class _DistributionEvaluator(Evaluator):
    """An evaluator that knows ROS_DISTRO, ROS_VERSION and the Python version."""

    def call(self, node: ast.Call) -> object:
        """Return the value of the variable, or the result of a string method."""
        match node:
            case ast.Call(func=func, args=[ast.Constant(value=key), *_]) if (
                key in _OF_ENVIRONMENT and self.module.qualified_name(func) == _GETTER
            ):
                return self._environment_value(key)
            case ast.Call(
                func=ast.Attribute(attr="get", value=holder), args=[ast.Constant(value=key), *_]
            ) if key in _OF_ENVIRONMENT and self._is_environment(holder):
                return self._environment_value(key)
            case ast.Call(
                func=ast.Attribute(attr="startswith" | "endswith" as method, value=holder),
                args=[argument],
                keywords=[],
            ):
                text, part = self.evaluate(holder), self.evaluate(argument)
                parts = part if isinstance(part, tuple) else (part,)
                words = [item for item in parts if isinstance(item, str)]
                if isinstance(text, str) and len(words) == len(parts):
                    begins = method == "startswith"
                    return any(
                        text.startswith(word) if begins else text.endswith(word) for word in words
                    )
            case ast.Call(func=ast.Name(id=name), args=[], keywords=[]):
                return self._returned(name, node.func)
            case ast.Call(func=ast.Attribute(attr="perform", value=holder)) if (
                self._is_substitution(holder)
            ):
                return self._environment_value(VARIABLE)
        for argument in node.args:
            self.evaluate(argument)  # evaluated for its notes
        return UNKNOWN

    def _is_substitution(self, node: ast.expr) -> bool:
        """Return whether an expression is the substitution of launch for the variable."""
        match _only_value(self.module, node) or node:
            case ast.Call(func=func, args=[ast.Constant(value=key), *_]) if key == VARIABLE:
                return self.module.qualified_name(func) == _SUBSTITUTION
        return False

    def _is_environment(self, node: ast.expr) -> bool:
        """Return whether an expression is the environment, of the process or a launch context."""
        node = _only_value(self.module, node) or node
        if self.module.qualified_name(node) == "os.environ":
            return True
        match node:
            case ast.Attribute(value=ast.Name() as holder, attr="environment"):
                bindings = self.module.index.bindings_of(holder)
                return [item.kind for item in bindings] == ["parameter"]
        return False

    def _returned(self, name: str, at: ast.expr) -> object:
        """Return the value of a function without arguments, if it only returns one."""
        lookup = self.module.index.lookup(name, at)
        match [item.node for item in (lookup[1] if lookup else ())]:
            case [ast.FunctionDef(body=[*_, ast.Return(value=value)] as body, decorator_list=[])]:
                is_all = all(isinstance(statement, ast.Expr) for statement in body[:-1])
                return self.evaluate(value) if is_all else UNKNOWN
        return UNKNOWN

    def attribute(self, node: ast.Attribute) -> object:
        """Return the value of an attribute of ``self`` that is set once."""
        index = self.module.index
        class_ = self.module.enclosing_class(node)
        if class_ is None or not isinstance(node.value, ast.Name) or node.value.id != "self":
            return UNKNOWN
        values = [binding.value for binding in index.bindings(class_).get(node.attr, ())]
        for store in index.attributes(node.attr):
            if not isinstance(store.ctx, ast.Load):
                above = index.parent(store)
                values.append(above.value if isinstance(above, ast.Assign) else None)
        evaluated = [self.evaluate(value) for value in values]  # evaluated for their notes
        return evaluated[0] if len(evaluated) == 1 else UNKNOWN

    def _imported(self, node: ast.expr) -> object:
        python = target().python
        match self.module.qualified_name(node):
            case "sys.version_info" | "sys.hexversion":
                value: object = RunningVersion(python)
            case "sys.version_info.major":
                value = python[0]
            case "sys.version_info.minor":
                value = python[1]
            case _:
                return super()._imported(node)
        self.note("sys.version_info")
        return value

    def _environment_value(self, variable: object) -> str:
        self.note(str(variable))
        return "2" if variable == _ROS_VERSION else target().name

    def subscript(self, node: ast.Subscript) -> object:
        """Return the value of an environment variable, or a part of the version."""
        match node:
            case ast.Subscript(value=value, slice=ast.Constant(value=key)) if (
                key in _OF_ENVIRONMENT
            ):
                if self._is_environment(value):
                    return self._environment_value(key)
            case ast.Subscript(
                value=holder,
                slice=ast.Slice(lower=None, upper=ast.Constant(value=int(end)), step=None),
            ) if end in {1, 2}:
                version = self.evaluate(holder)
                if isinstance(version, RunningVersion):
                    return tuple(version[:end])
            case ast.Subscript(value=holder, slice=ast.UnaryOp()) if isinstance(
                self.evaluate(holder), RunningVersion
            ):
                return UNKNOWN  # its end is unknown
        return super().subscript(node)

    def comparison(self, node: ast.Compare) -> object:
        """Return the result of a comparison, also of versions and with several operators."""
        operands = [node.left, *node.comparators]
        results: list[object] = []
        for left, operator_, right in zip(operands, node.ops, operands[1:], strict=False):
            results.append(self._pair(left, operator_, right))
        if False in results:
            return False
        return all(results) if all(map(is_known, results)) else UNKNOWN

    def _pair(self, left: ast.expr, compare: ast.cmpop, right: ast.expr) -> object:
        """Return the result of comparing two expressions."""
        if isinstance(compare, ast.In | ast.NotIn):
            if self._is_environment(right):
                return self._is_set(left, compare)
            return self._contained(self.evaluate(left), compare, self.evaluate(right))
        first, second = self.evaluate(left), self.evaluate(right)
        if first is UNKNOWN and self._is_ros_version(left):
            first = self._ros_version_as(second)
        kind = type(compare)
        result: object = None
        if isinstance(second, RunningVersion):
            result = second.compare(SWAPPED.get(kind, kind), first)
        elif isinstance(first, RunningVersion):
            result = first.compare(kind, second)
        elif is_known(first) and is_known(second):
            with suppress(TypeError):  # of 3 < 'x'
                compared = COMPARISONS.get(kind) or _ORDERS.get(kind)
                result = None if compared is None else compared(first, second)
        return UNKNOWN if result is None else result

    def _is_ros_version(self, node: ast.expr) -> bool:
        """Return whether a name, or the argument of a conversion, is ``ros_version``."""
        match node:
            case ast.Call(args=[argument], keywords=[]):
                return self._is_ros_version(argument)
            case ast.Name(id=name) | ast.Attribute(attr=name):
                return name.upper() == _ROS_VERSION
        return False

    def _ros_version_as(self, other: object) -> object:
        """Return ROS_VERSION with the type of the compared value."""
        if str(other) not in {"1", "2"} or not isinstance(other, int | str):
            return UNKNOWN
        self.note(_ROS_VERSION)
        return type(other)(2)

    def _is_set(self, name: ast.expr, compare: ast.cmpop) -> object:
        """Return whether a variable is in the environment."""
        if not isinstance(name, ast.Constant) or name.value != VARIABLE:
            return UNKNOWN
        self.note(VARIABLE)
        return isinstance(compare, ast.In)

    def _contained(self, item: object, op: ast.cmpop, holder: object) -> object:
        if not isinstance(item, str) or not isinstance(holder, str | tuple | list | set | dict):
            return UNKNOWN
        if not isinstance(holder, str) and not all(isinstance(element, str) for element in holder):
            return UNKNOWN
        return (item in holder) == isinstance(op, ast.In)
