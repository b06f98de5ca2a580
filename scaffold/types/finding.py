"""A report of the type checker: its location, message and source code."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator, Sequence
from functools import cached_property
from typing import TypeVar

from scaffold import lazy_re
from scaffold.model.package import Package
from scaffold.model.python.conditions.distribution_branches import stretches_not_run
from scaffold.model.python.conditions.distribution_conditions import open_parts
from scaffold.model.python.conditions.guards import (
    Condition,
    all_conditions,
    has_fallback,
    is_probe,
    values_asked,
)
from scaffold.model.python.conditions.handlers import is_tested_to_fail, last_names
from scaffold.model.python.evaluation.given_arguments import arguments_for
from scaffold.model.python.module import PythonModule
from scaffold.model.rclpy.evaluation.attributes import is_set_by_subclass
from scaffold.source import Location
from scaffold.types import origins
from scaffold.types.arithmetic import may_be_of_library
from scaffold.types.rewriting.passed import CallPlace, calls_from_modules
from scaffold.types.ros1 import is_for_ros1
from scaffold.types.stubs.marks import MARKED, full_name, short_name
from scaffold.types.ty import TyDiagnostic

Node = TypeVar("Node", bound=ast.AST)

_DECIDING = lazy_re.compile(
    r"\b(?:hasattr|getattr|callable|isinstance|issubclass|TYPE_CHECKING|platform|ROS_VERSION)\b"
    r"|\bin dir\(|__slots__|get_fields_and_field_types|signature|find_spec"
    r"|(?:^|[^a-z]|hex)version|distro|_AVAILABLE\b"
    r"|\b(?:HAS|HAVE)_(?!next\b)|\bPY_?[23]\d{0,2}\b",
    re.IGNORECASE,
)
"""Matches conditions on a version, a module or the type of an object."""
_OF_OWN = lazy_re.compile(r"(?:has|get)attr\(self, '(\w+)'(?:, \w+)?\)")
"""Matches a check whether ``self`` has an attribute."""
_LEAVING = lazy_re.compile(
    r"version_info|\bPY_?[23]\d{0,2}\b|hexversion|__version__|(?i:distro)|find_spec|importorskip"
)
"""Matches conditions on a version or a module that may leave a block."""
_PROBED = frozenset(
    {"AttributeError", "ImportError", "ModuleNotFoundError", "NameError", "TypeError"}
)
_ANYTHING = frozenset({"Exception", "BaseException"})
_OF_ELEMENTS = frozenset({"not-subscriptable", "not-iterable"})
"""Kinds of reports about an object, not about a call."""
_OF_ARGUMENTS = frozenset(
    {"invalid-argument-type", "too-many-positional-arguments", "unknown-argument"}
)
"""Kinds of reports about a call that always fails."""
# linear: only searched in the text of a called function
_PATCHING = lazy_re.compile(r"\bpatch(?:\.object)?$|\bmonkeypatch\.setattr$")
"""Matches calls that replace an attribute during a test."""


class TypeFinding:
    """A report at a location.

    Args:
        package: Where the file is.
        path: The file.
        reported: The report of the type checker.
    """

    def __init__(self, package: Package, path: str, reported: TyDiagnostic) -> None:
        self.package = package
        self.path = path
        self.kind = reported.kind
        self.message = reported.message
        shift = int(reported.line == 1 and self.module.has_bom)
        self.location = Location(
            path,
            reported.line,
            reported.column + shift,
            reported.end_line,
            reported.end_column + shift,
        )

    @cached_property
    def module(self) -> PythonModule:
        """The file; raises ViewError if it cannot be parsed."""
        return self.package.module(self.path)

    def match(self, pattern: str) -> re.Match[str] | None:
        """Match the whole message."""
        return re.fullmatch(pattern, self.message, re.DOTALL)

    def node(self, *kinds: type[Node]) -> Node | None:
        """Return the outermost node of some types with exactly the reported range."""
        for kind in kinds:
            for node in self.module.walk(kind):
                if getattr(node, "lineno", 0) != self.location.line:
                    continue
                if self.module.exact_location(node) == self.location:
                    return node
        return None

    def parents(self) -> Iterator[ast.AST]:
        """Yield the nodes around the reported place, inner ones first."""
        if self.innermost is not None:
            yield from self.module.parents(self.innermost)

    @property
    def enclosing_call(self) -> ast.Call | None:
        """The innermost call around the place."""
        return self.module.enclosing(self.innermost, ast.Call) if self.innermost else None

    def expression(self) -> ast.expr | None:
        """Return the outermost expression with exactly the reported range."""
        return self.node(
            *(ast.Attribute, ast.Call, ast.Name, ast.Constant, ast.BinOp, ast.Subscript),
            *(ast.Lambda, ast.List, ast.Tuple, ast.Dict, ast.JoinedStr, ast.Compare, ast.UnaryOp),
            *(ast.Set, ast.IfExp, ast.BoolOp, ast.ListComp, ast.Starred, ast.Await),
        )

    def passed_in(self) -> tuple[str, str] | None:
        """Return the parameter that the report is about, and the location of the call."""
        node = self._root
        if node is None or (node.id == "self" and node is self.expression()):
            return None
        given: list[tuple[PythonModule, ast.expr | None, str]] = [
            (self.module, value, f"line {value.lineno}")
            for value in sorted(arguments_for(self.module, node), key=lambda value: value.lineno)
        ]
        given += origins.given_by_modules(self.package, self.path, node)
        # what a caller hands on comes from another place
        first = [place for module, value, place in given if not origins.is_handed_on(module, value)]
        first += [place for _, _, place in given]
        return (node.id, first[0]) if first else None

    def calls_from_modules(self, function: str) -> Iterator[CallPlace]:
        """Yield the place of each call of a function of this file by other modules."""
        return calls_from_modules(self.package, self.path, function)

    def arguments_for(self, name: ast.Name) -> Sequence[ast.expr]:
        """Return the arguments that calls in the file pass for a parameter."""
        return arguments_for(self.module, name)

    @cached_property
    def _root(self) -> ast.Name | None:
        """The name that the reported expression starts with."""
        node = self.expression()
        while isinstance(node, ast.Attribute | ast.Subscript):
            node = node.value
        return node if isinstance(node, ast.Name) else None

    @cached_property
    def innermost(self) -> ast.AST | None:
        """The smallest node that contains the reported range."""
        at = self.location
        start, end = (at.line, at.column), (at.end_line, at.end_column)
        best: ast.AST | None = None
        for node in self._enclosing_nodes():
            place = self.module.exact_location(node)
            if (place.line, place.column) <= start and end <= (place.end_line, place.end_column):
                best = node
        return best

    def _enclosing_nodes(self) -> Iterator[ast.AST]:
        """Yield the nodes whose lines contain the reported place, outer ones first."""
        pending: list[ast.AST] = [self.module.tree]
        line = self.location.line
        while pending:
            node = pending.pop()
            first = getattr(node, "lineno", None)
            if first is not None:
                decorators = getattr(node, "decorator_list", ())
                first = min([first, *(item.lineno for item in decorators)])
                if not first <= line <= (getattr(node, "end_lineno", None) or first):
                    continue
                yield node
            pending.extend(ast.iter_child_nodes(node))

    def may_be_text(self) -> bool:
        """Return whether the called method of bytes may be one of a str."""
        call = self.enclosing_call
        return call is not None and origins.may_be_text(self.module, call.func)

    def is_certain(self) -> bool:
        """Return whether no code around the place anticipates the reported error.

        Checks of a version, a module or an attribute, and ``try`` blocks, anticipate it.
        """
        node = self.innermost
        if node is None or self._is_of_several(node) or self._is_of_another(node):
            return False
        if is_tested_to_fail(self.module, node) or self._is_changed_later(node):
            return False
        conditions = [*all_conditions(self.module, node)]
        if (
            any(map(self._asks_what_there_is, conditions))
            or self._asks_arguments(conditions)
            or self._asks_element(conditions)
        ):
            return False
        child = node
        for parent in self.module.parents(node):
            match parent:
                case ast.Try() if self._is_tried(parent, child):
                    return False
                case ast.With(items=items) | ast.AsyncWith(items=items):
                    if any(_suppresses(item.context_expr) for item in items):
                        return False
            child = parent
        return child not in self.module.passed_over and not is_for_ros1(self.module, node)

    def _is_changed_later(self, node: ast.AST) -> bool:
        """Return whether what is used is patched, imported or defined again."""
        return (
            self._is_patched(node)
            or self._is_imported_anew(node)
            or self._is_defined_again(node)
            or self._is_set_by_subclass(node)
        )

    def _is_set_by_subclass(self, node: ast.AST) -> bool:
        """Return whether a subclass sets an attribute of ``self`` that is used."""
        class_ = self.module.enclosing_class(node)
        around = node if isinstance(node, ast.Call) else self.module.enclosing(node, ast.Call)
        names = {
            attribute.attr
            for attribute in self.module.below(around or node, ast.Attribute)
            if self.module.text(attribute.value) == "self"
        }
        return (
            bool(names)
            and class_ is not None
            and is_set_by_subclass(self.package, class_.name, names)
        )

    def _is_patched(self, node: ast.AST) -> bool:
        """Return whether a test patches what is used."""
        module = self.module
        if not module.mentions("patch"):
            return False
        around = [node, *module.parents(node)]
        called = [item.func for item in around if isinstance(item, ast.Call)]
        used = {item.attr for item in (*around, *called) if isinstance(item, ast.Attribute)}
        functions = (
            item for item in around if isinstance(item, ast.FunctionDef | ast.AsyncFunctionDef)
        )
        return any(
            isinstance(given, ast.Constant) and str(given.value).rpartition(".")[2] in used
            for function in functions
            for call in ast.walk(function)
            if isinstance(call, ast.Call) and _PATCHING.search(module.text(call.func))
            for given in call.args
        )

    def _is_imported_anew(self, node: ast.AST) -> bool:
        """Return whether a name in a function is bound by a later import than the reported one.

        The type checker uses the union of all imports of the name.
        """
        module = self.module
        if module.enclosing_function(node) is None:
            return False
        names = re.findall(MARKED, self.message)
        reported = {full_name(name).partition(".")[0] for name in names}
        call = node if isinstance(node, ast.Call) else module.enclosing(node, ast.Call) or node
        for use in module.below(call, ast.Name):
            *earlier, last = self._imports_of(use) or [""]
            if last not in reported and not reported.isdisjoint(earlier):
                return True
        return False

    def _is_defined_again(self, node: ast.AST) -> bool:
        """Return whether a function or class called in a function is defined more than once.

        The type checker checks such a call against all definitions; the last one is called. The
        same applies to an attribute that replaces the method of its name.
        """
        module = self.module
        call = node if isinstance(node, ast.Call) else module.enclosing(node, ast.Call)
        if call is not None and isinstance(call.func, ast.Attribute):
            return self._is_replaced(call.func)
        if call is None or not isinstance(call.func, ast.Name):
            return False
        kinds = [binding.kind for binding in module.index.bindings_of(call.func)]
        is_inside = module.enclosing_function(node) is not None
        return is_inside and len(kinds) > 1 and not {"function", "class"}.isdisjoint(kinds)

    def _is_replaced(self, method: ast.Attribute) -> bool:
        """Return whether a class has a method and also assigns the attribute of that name."""
        module, name = self.module, method.attr
        class_ = module.enclosing_class(method)
        if class_ is None or module.text(method.value) != "self":
            return False
        if all(
            binding.kind != "function" for binding in module.index.bindings(class_).get(name, ())
        ):
            return False
        return self._is_stored(name)

    def _is_stored(self, name: str) -> bool:
        """Return whether the file sets an attribute of ``self``."""
        uses = self.module.index.attributes(name)
        return any(
            isinstance(it.ctx, ast.Store) and self.module.text(it.value) == "self" for it in uses
        )

    def _imports_of(self, name: ast.Name) -> list[str]:
        """Return the packages that a name is imported from, if nothing else binds it."""
        bindings = self.module.index.bindings_of(name)
        if any(binding.kind != "import" for binding in bindings):
            return []
        statements = (self.module.parent(binding.node) for binding in bindings)
        if any(
            statement is None or self.module.parent(statement) is not self.module.tree
            for statement in statements
        ):
            return []  # one of them is for another version or platform
        return [binding.target.partition(".")[0] for binding in bindings]

    def _is_of_several(self, node: ast.AST) -> bool:
        """Return whether the called or used object may be another one than the reported one."""
        if self._is_calculated_from_several(node):
            return True
        if self.kind == "missing-attribute":
            # otherwise only reported if no object of them has it
            return origins.is_placeholder(self.module, node)
        assigned = self.module.enclosing(node, ast.Assign)
        if assigned is not None and "to unpack" in self.message:
            return origins.is_unpacked_of_several(self.module, assigned.value)
        if assigned is not None and self.kind == "invalid-assignment":
            return origins.is_assigned_of_several(self.module, assigned, node)
        call = self.module.enclosing(node, ast.Call)
        called: list[ast.AST] = [item.func for item in (node, call) if isinstance(item, ast.Call)]
        if any(isinstance(func, ast.Subscript) for func in called):
            return True
        if self.kind in _OF_ELEMENTS:
            called = [node]
        expected = self.message.partition("Expected ")[2].partition(", found")[0]
        names = {short_name(name) for name in re.findall(MARKED, expected)}
        return any(origins.is_of_several(self.module, item, names) for item in called or [node])

    def _is_calculated_from_several(self, node: ast.AST) -> bool:
        """Return whether an operand or a value may be of another type than the reported one."""
        match node:
            case ast.AugAssign(target=target) if origins.is_of_several(self.module, target):
                return True  # the type checker reports each type by itself
            case ast.BinOp(left=left, right=right) | ast.AugAssign(target=left, value=right):
                if any(
                    isinstance(part, ast.Subscript) and origins.is_of_several(self.module, part)
                    for part in (left, right)
                ):
                    return True
                parts: tuple[ast.AST, ...] = (left, right)
            case _:
                parts = (node,)
        return any(
            origins.has_default(self.module, part) or may_be_of_library(self.module, part)
            for part in parts
        )

    def _is_of_another(self, node: ast.AST) -> bool:
        """Return whether code for another distribution sets a name and thereby its type."""
        not_run = [*stretches_not_run(self.module)]
        if not not_run:
            return False
        call = self.module.enclosing(node, ast.Call) or node
        places = [self.module.location(binding) for binding in self._bindings(call)]
        return any(
            stretch[:2] <= (place.line, place.column) < stretch[2:]
            for place in places
            for stretch in not_run
        )

    def _bindings(self, node: ast.AST) -> Iterator[ast.AST]:
        """Yield the assignments of names and attributes of ``self`` below a node."""
        index = self.module.index
        for name in self.module.below(node, ast.Name):
            yield from (binding.node for binding in index.bindings_of(name))
        for attribute in self.module.below(node, ast.Attribute):
            if isinstance(attribute.value, ast.Name) and attribute.value.id == "self":
                stores = index.attributes(attribute.attr)
                yield from (store for store in stores if isinstance(store.ctx, ast.Store))

    def _asks_what_there_is(self, condition: Condition) -> bool:
        """Return whether a condition checks a version, the type of an object, or an import."""
        parts = [*open_parts(self.module, condition.test)]
        values = [value for part in parts for value in values_asked(self.module, part)]
        texts = [_OF_OWN.sub(self._unless_stored, ast.unparse(value)) for value in values]
        if condition.is_of_leaving:
            return any(map(_LEAVING.search, texts))
        if any(map(_DECIDING.search, texts)):
            return True
        nodes = (node for part in parts for node in ast.walk(part))
        names = {node.id for node in nodes if isinstance(node, ast.Name)}
        return not names.isdisjoint(self._imported)

    def _unless_stored(self, check: re.Match[str]) -> str:
        """Return a check for an attribute, or nothing if the file sets that: it may come later."""
        return "" if self._is_stored(check[1]) else check[0]

    def _asks_arguments(self, conditions: Sequence[Condition]) -> bool:
        """Return whether the place runs only for some values of another argument."""
        root = self._root
        others = origins.other_parameters(self.module, root) if root else frozenset()
        if not others or self.passed_in() is None:
            return False
        tests = [
            test
            for item in conditions
            for test in (_cases(item.test) if item.is_of_leaving else [item.test])
        ]
        names = {node.id for test in tests for node in ast.walk(test) if isinstance(node, ast.Name)}
        return not names.isdisjoint(others)

    def _asks_element(self, conditions: Sequence[Condition]) -> bool:
        """Return whether another element of the same sequence determines the type of an element.

        In ``if step[0] == 'turn':`` before ``step[1]``, the first element is the kind of step.
        """
        node = self.expression()
        parts = [*ast.walk(node)] if node is not None else []
        wholes = {self.module.text(it.value) for it in parts if isinstance(it, ast.Subscript)}
        if not wholes:
            return False
        return any(
            isinstance(asked, ast.Subscript) and self.module.text(asked.value) in wholes
            for condition in conditions
            for asked in ast.walk(condition.test)
            if not _is_measured(self.module, asked)
        )

    @cached_property
    def _imported(self) -> frozenset[str]:
        """The names that imports bind in the file, where an import may fail."""
        return frozenset(
            name
            for item in self.module.imports
            if item.guarded
            for name in (item.asname, *(alias.asname or alias.name for alias in item.names))
            if name
        )

    def _is_tried(self, node: ast.Try, child: ast.AST) -> bool:
        place = self.module.index.place(child)[0]
        if place == "finalbody":
            return False
        for handler in node.handlers:
            names = last_names(handler.type) if handler.type is not None else _ANYTHING
            if names & _PROBED:
                return True
            if place == "body" and names & _ANYTHING and self._is_asked(node, handler, child):
                return True
        return False

    def _is_asked(self, node: ast.Try, handler: ast.ExceptHandler, child: ast.AST) -> bool:
        """Return whether a ``try`` only probes whether something works.

        One whose handlers only log the error does not.
        """
        if has_fallback(self.module, child, is_rare=False):
            return True
        return self.kind not in _OF_ARGUMENTS and is_probe(node, handler)


def _is_measured(module: PythonModule, node: ast.AST) -> bool:
    """Return whether a number is compared with a limit, which tells nothing about types."""
    compared = module.enclosing(node, ast.Compare)
    return compared is not None and all(
        isinstance(operator, ast.Lt | ast.LtE | ast.Gt | ast.GtE) for operator in compared.ops
    )


def _cases(condition: ast.expr) -> Iterator[ast.Compare]:
    """Yield the comparisons in a condition that select some values."""
    for node in ast.walk(condition):
        if isinstance(node, ast.Compare) and isinstance(node.ops[0], ast.Eq | ast.In):
            yield node


def _suppresses(expression: ast.expr) -> bool:
    return isinstance(expression, ast.Call) and "suppress" in last_names(expression.func)
