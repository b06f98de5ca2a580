"""The call sites of functions and constructors in a file, if all are known."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from scaffold.model.python.evaluation.attributes import AttributeEvaluator
    from scaffold.model.python.scopes import FunctionNode

_MAX_CLASSES = 40


class CallSites:
    """Finds the calls of a function in its file."""

    def __init__(self, evaluator: AttributeEvaluator) -> None:
        self._evaluator = evaluator
        self._calls: dict[FunctionNode, Sequence[ast.Call] | None] = {}

    def of(self, function: FunctionNode) -> Sequence[ast.Call] | None:
        """Return all calls of a function; ``None`` if there may be others."""
        if function not in self._calls:
            self._calls[function] = self._find(function)
        return self._calls[function]

    def _find(self, function: FunctionNode) -> Sequence[ast.Call] | None:
        class_ = self._evaluator.module.parent(function)
        if not isinstance(class_, ast.ClassDef):
            is_nested = self._evaluator.module.enclosing_function(function) is not None
            return self._calls_by_name(function) if is_nested or _is_private(function) else None
        if function.name == "__init__":
            return self._constructions(class_, [])
        return self._method_calls(function, class_) if _is_private(function) else None

    def _calls_by_name(self, node: FunctionNode | ast.ClassDef) -> list[ast.Call] | None:
        calls: list[ast.Call] = []
        for name in self._evaluator.module.index.names(node.name):
            if not isinstance(name.ctx, ast.Load):
                continue
            lookup = self._evaluator.module.index.lookup(name.id, name)
            if lookup is None or all(binding.node is not node for binding in lookup[1]):
                continue
            parent = self._evaluator.module.parent(name)
            if isinstance(parent, ast.Call) and parent.func is name and len(lookup[1]) == 1:
                calls.append(parent)
            elif not isinstance(node, ast.ClassDef) or not self._is_mention(name, parent):
                return None
        return calls

    def _is_mention(self, name: ast.Name, parent: ast.AST | None) -> bool:
        """Return whether a class is only mentioned: as a base, in an annotation, for a constant."""
        if isinstance(parent, ast.ClassDef | ast.arg | ast.AnnAssign | ast.Attribute):
            return True
        if isinstance(parent, ast.FunctionDef | ast.AsyncFunctionDef):
            return parent.returns is name
        return isinstance(parent, ast.Call) and (
            self._evaluator.module.qualified_name(parent.func)
            in {"isinstance", "super", "issubclass"}
        )

    def _constructions(
        self, class_: ast.ClassDef, seen: list[ast.ClassDef]
    ) -> list[ast.Call] | None:
        """Return the calls that reach the constructor of a class, also from subclasses."""
        seen.append(class_)
        if len(seen) > _MAX_CLASSES:
            return None
        calls = self._calls_by_name(class_)
        for other in self._evaluator.module.walk(ast.ClassDef):
            if calls is None:
                return None
            if other in seen or class_ not in map(self._evaluator.named_class, other.bases):
                continue
            constructors = [
                node
                for binding in self._evaluator.module.index.bindings(other).get("__init__", ())
                if isinstance(node := binding.node, ast.FunctionDef)
            ]
            if constructors:
                calls.extend(self._super_calls(constructors[-1]))
            else:
                inherited = self._constructions(other, seen)
                calls = None if inherited is None else [*calls, *inherited]
        return calls

    def _super_calls(self, constructor: ast.FunctionDef) -> Iterator[ast.Call]:
        for call in self._evaluator.module.walk(ast.Call):
            match call.func:
                case ast.Attribute(attr="__init__", value=ast.Call(func=ast.Name(id="super"))):
                    if self._evaluator.module.enclosing_function(call) is constructor:
                        yield call

    def _method_calls(self, function: FunctionNode, class_: ast.ClassDef) -> list[ast.Call] | None:
        calls: list[ast.Call] = []
        family = self._evaluator.related(class_)
        for node in self._evaluator.module.index.attributes(function.name):
            holder = self._evaluator.self_class(node.value)
            if holder is not None and holder not in family:
                continue
            call = self._evaluator.module.call_with(node)
            if holder is None or call is None:
                return None
            calls.append(call)
        return calls


def _is_private(function: FunctionNode) -> bool:
    return function.name.startswith("_") and not function.decorator_list
