"""Static evaluation of expressions: the value if it is certain, else UNKNOWN."""

from __future__ import annotations

import ast
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from functools import partial
from typing import TYPE_CHECKING

from scaffold.model.python.evaluation.given_arguments import given_argument
from scaffold.model.python.evaluation.list_changes import (
    changes_of,
    is_straight,
    list_literal,
    statement_of,
)
from scaffold.model.python.evaluation.operations import (
    OPERATIONS,
    comparison,
    joined_path,
    method_result,
    subscript,
)
from scaffold.model.python.evaluation.returns import only_result
from scaffold.model.python.evaluation.values import (
    FUNCTIONS,
    NAMED_VALUES,
    UNKNOWN,
    Glob,
    Unknown,
    held_small,
    is_known,
    same,
)
from scaffold.record import NamedTuple

if TYPE_CHECKING:
    from scaffold.model.python.scopes import Binding
    from scaffold.model.python.syntax_tree import SyntaxTree


class Element(NamedTuple):
    """An item of a list, and its location."""

    node: ast.expr
    value: object
    conditional: bool = False
    """Whether it is added under a condition or in a loop."""


class Elements(NamedTuple):
    """The known items of a list."""

    items: tuple[Element, ...]
    complete: bool
    """Whether these are all."""


MAX_DEPTH = 60
"""The maximum nesting of expressions, also through names."""
MOST_ASSIGNMENTS = 200
"""The maximum number of assignments of a name; with more its value is unknown."""
MAX_STEPS = 20_000
"""The maximum number of expressions visited for one value, as references multiply."""
MOST_STEPS = 300_000
"""The number of expressions visited in a file, after which each value gets only FEW_STEPS."""
FEW_STEPS = 100


_NO_NOTES = frozenset[str]()
"""Shared, as most values have none, and Python makes a new empty set each time."""


class Evaluator:
    """Evaluates the expressions of one module.

    A name has the value of its assignments, if they agree; a list is extended by the
    ``append`` and ``extend`` calls that follow in the same block. Subclasses add the
    values of attributes and calls.
    """

    def __init__(self, module: SyntaxTree) -> None:
        self.module = module
        self._depth = 0
        self._steps = self._spent = 0
        self._most = MAX_STEPS
        self._is_cut = False
        self._running: set[ast.AST] = set()
        self._memo: dict[ast.AST, tuple[object, frozenset[str]]] = {}
        self._local: dict[tuple[ast.AST, str], object] = {}
        self._notes = _NO_NOTES
        self._methods: Mapping[type[ast.expr], Callable[..., object]] = {
            ast.Name: self._name,
            ast.Attribute: self._attribute,
            ast.Compare: self.comparison,
            ast.Subscript: self.subscript,
            **{kind: partial(value_of, self.evaluate) for kind, value_of in OPERATIONS.items()},
            ast.ListComp: self._comprehension,
            ast.GeneratorExp: self._comprehension,
            ast.Call: self._call,
        }

    # -- what callers use

    def evaluate(self, node: ast.expr | None) -> object:
        """Return the value of an expression; ``UNKNOWN`` for none."""
        if node is None:
            return UNKNOWN
        if isinstance(node, ast.Constant):
            return UNKNOWN if node.value is ... else node.value
        if not self._local and node in self._memo:
            value, notes = self._memo[node]
            if notes:
                self._notes |= notes
            return value
        method = self._methods.get(type(node))
        if method is None:
            return UNKNOWN
        if self._depth == 0:
            self._start()
        self._steps += 1
        if node in self._running or self._depth >= MAX_DEPTH or self._steps > self._most:
            self._is_cut = True
            return UNKNOWN
        return self._visit(node, method)

    def _start(self) -> None:
        """Begin with a value of its own."""
        self._spent += self._steps
        self._most = MAX_STEPS if self._spent < MOST_STEPS else FEW_STEPS
        self._steps = 0

    def _visit(self, node: ast.expr, method: Callable[..., object]) -> object:
        """Evaluate a node, and remember its value unless it was cut short or depends on names."""
        self._running.add(node)
        self._depth += 1
        outer, self._notes = self._notes, _NO_NOTES
        try:
            value = held_small(method(node))
        finally:
            self._depth -= 1
            self._running.discard(node)
            notes = self._notes
            self._notes = outer | notes if outer and notes else outer or notes
        if not self._local and not self._is_cut:
            self._memo[node] = value, notes
        if self._depth == 0:
            self._is_cut = False
        return value

    def text(self, node: ast.expr | None) -> str | Unknown:
        """Return the value of an expression if it is a string."""
        value = self.evaluate(node)
        return value if isinstance(value, str) else UNKNOWN

    def number(self, node: ast.expr | None) -> float | Unknown:
        """Return the value of an expression if it is a number (a bool is none)."""
        value = self.evaluate(node)
        return value if isinstance(value, int | float) and type(value) is not bool else UNKNOWN

    def elements(self, node: ast.expr) -> Elements:
        """Return the items of a list or tuple, each with its location."""
        if self._depth == 0:
            self._start()
        self._depth += 1
        items: list[Element] = []
        try:
            complete = all([*self._collect(node, items, 0)])
        finally:
            self._depth -= 1
        if self._depth == 0:
            self._is_cut = False
        return Elements(tuple(items), complete)

    def trace(self, node: ast.expr | None) -> tuple[object, frozenset[str]]:
        """Return a value, and the notes by subclasses about its origin."""
        outer, self._notes = self._notes, _NO_NOTES
        value = self.evaluate(node)
        notes, self._notes = self._notes, outer
        return value, notes

    # -- for subclasses

    def note(self, text: str) -> None:
        """Add a note about the value being evaluated."""
        self._notes |= {text}

    def cut(self) -> None:
        """Mark the value being evaluated as provisional, so that it is not cached."""
        self._is_cut = True

    def imported(self, name: str) -> object:
        """Return the value of a dotted name that is imported."""
        del name
        return UNKNOWN

    def argument(self, node: ast.arg) -> object:
        """Return the value of a function's parameter in the function."""
        del node
        return UNKNOWN

    def attribute(self, node: ast.Attribute) -> object:
        """Return the value of an attribute other than known constants."""
        del node
        return UNKNOWN

    def call(self, node: ast.Call) -> object:
        """Return the value of a call other than of known functions."""
        del node
        return UNKNOWN

    def comparison(self, node: ast.Compare) -> object:
        """Return the result of a comparison."""
        return comparison(self.evaluate, node)

    def subscript(self, node: ast.Subscript) -> object:
        """Return an item of a list, a text or a dictionary."""
        return subscript(self.evaluate, node)

    # -- lists

    def _collect(self, node: ast.expr, items: list[Element], depth: int) -> Iterator[bool]:
        """Append the items of a list; yield false for every unknown part."""
        self._steps += 1
        if depth > MAX_DEPTH or self._steps > self._most:
            self._is_cut = True
            yield False
            return
        match node:
            case ast.List(elts=parts) | ast.Tuple(elts=parts):
                for part in parts:
                    if isinstance(part, ast.Starred):
                        yield from self._collect(part.value, items, depth + 1)
                    else:
                        items.append(Element(part, self.evaluate(part)))
            case ast.BinOp(left=left, op=ast.Add(), right=right):
                yield from self._collect(left, items, depth + 1)
                yield from self._collect(right, items, depth + 1)
            case ast.Name() if list_literal(self.module, node) is not None:
                yield from self._collect_named(node, items, depth)
            case _:
                value = self.evaluate(node)
                if isinstance(value, list | tuple):
                    items.extend(Element(node, item) for item in value)
                yield isinstance(value, list | tuple)

    def _collect_named(self, node: ast.Name, items: list[Element], depth: int) -> Iterator[bool]:
        literal = list_literal(self.module, node)
        if literal is None:
            return
        yield from self._collect(literal, items, depth + 1)
        statement = statement_of(self.module, literal)
        for change in changes_of(self.module, node):
            straight = is_straight(self.module, statement, change)
            if straight and change.lineno > node.lineno:
                continue
            before = len(items)
            yield from self._collect_change(change, items, depth)
            if not straight:
                items[before:] = [item._replace(conditional=True) for item in items[before:]]
                yield False

    def _collect_change(self, change: ast.Name, items: list[Element], depth: int) -> Iterator[bool]:
        parent = self.module.parent(change)
        call = self.module.parent(parent) if parent else None
        match parent, call:
            case ast.AugAssign(op=ast.Add(), value=value), _:
                yield from self._collect(value, items, depth + 1)
            case ast.Attribute(attr="append"), ast.Call(args=[value], keywords=[]):
                items.append(Element(value, self.evaluate(value)))
            case ast.Attribute(attr="extend"), ast.Call(args=[value], keywords=[]):
                yield from self._collect(value, items, depth + 1)
            case _:
                yield False

    # -- expressions

    def _name(self, node: ast.Name) -> object:
        lookup = self.module.index.lookup(node.id, node)
        if lookup is None:
            return UNKNOWN
        scope, bindings = lookup
        if (scope, node.id) in self._local:
            return self._local[scope, node.id]
        if list_literal(self.module, node) is not None:
            items = self.elements(node)
            return [item.value for item in items.items] if items.complete else UNKNOWN
        return self._common_value(node, bindings)

    def _common_value(self, node: ast.Name, bindings: Sequence[Binding]) -> object:
        """Return the value that all assignments of a name agree on."""
        if any(binding.kind == "import" for binding in bindings):
            return self._imported(node)
        assigned = [binding for binding in bindings if binding.kind != "annotation"]
        if len(assigned) == 1 and isinstance(assigned[0].node, ast.arg):
            return self.argument(assigned[0].node)
        if not 0 < len(assigned) <= MOST_ASSIGNMENTS or any(
            binding.kind != "assignment" for binding in assigned
        ):
            return UNKNOWN
        values = [self.evaluate(binding.value) for binding in assigned]
        if any(value is UNKNOWN or not same(value, values[0]) for value in values):
            return UNKNOWN
        if isinstance(values[0], list | dict | set) and changes_of(self.module, node):
            return UNKNOWN
        return values[0]

    def _imported(self, node: ast.expr) -> object:
        name = self.module.qualified_name(node) or ""
        value = NAMED_VALUES.get(name, UNKNOWN)
        return self.imported(name) if value is UNKNOWN and "." in name else value

    def _attribute(self, node: ast.Attribute) -> object:
        value = self._imported(node)
        return self.attribute(node) if value is UNKNOWN else value

    def _comprehension(self, node: ast.ListComp | ast.GeneratorExp) -> object:
        if len(node.generators) != 1 or node.generators[0].is_async:
            return UNKNOWN
        generator = node.generators[0]
        values = self.evaluate(generator.iter)
        if not isinstance(values, list | tuple) or not isinstance(generator.target, ast.Name):
            return UNKNOWN
        result: list[object] = []
        for value in values:
            with self._bound(node, {generator.target.id: value}):
                tests = [self.evaluate(test) for test in generator.ifs]
                item = self.evaluate(node.elt)
            if isinstance(item, Glob):
                filtered = item.filtered or bool(tests)
                result.append(Glob(item.pattern, recursive=item.recursive, filtered=filtered))
            elif not all(map(is_known, tests)) or item is UNKNOWN:
                return UNKNOWN
            elif all(tests):
                result.append(item)
        return result

    @contextmanager
    def _bound(self, scope: ast.AST, values: Mapping[str, object]) -> Iterator[None]:
        """Bind names of a scope to values temporarily."""
        outer = self._local
        self._local = {**outer, **{(scope, name): value for name, value in values.items()}}
        try:
            yield
        finally:
            self._local = outer

    # -- calls

    def _call(self, node: ast.Call) -> object:
        name = self.module.qualified_name(node.func)
        if (
            name is not None
            and name in FUNCTIONS
            and not any(isinstance(arg, ast.Starred) for arg in node.args)
        ):
            args = [self.evaluate(arg) for arg in node.args]
            keywords = {word.arg or "**": self.evaluate(word.value) for word in node.keywords}
            return FUNCTIONS[name](args, keywords)
        if name == "os.path.join":
            return joined_path(self.evaluate, node)
        if isinstance(node.func, ast.Attribute) and name is None:
            value = method_result(self.evaluate, node, node.func)
            if value is not UNKNOWN:
                return value
        value = self.call(node)
        return self._result(node) if value is UNKNOWN else value

    def _result(self, node: ast.Call) -> object:
        """Return the value of a call of a function of the file that returns one expression."""
        result = only_result(self.module, node.func)
        if result is None:
            return UNKNOWN
        function, returned = result
        parameters = (*function.args.posonlyargs, *function.args.args, *function.args.kwonlyargs)
        given = {
            item.arg: self.evaluate(given_argument(function, node, item, is_method=False))
            for item in parameters
        }
        with self._bound(function, given):
            return self.evaluate(returned)
