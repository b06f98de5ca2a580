"""Static evaluation of expressions: the value if it is certain, else UNKNOWN."""

from __future__ import annotations

import ast
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from functools import partial
from itertools import islice
from typing import TYPE_CHECKING

from scaffold.model.python.evaluation.execution import (
    Execution,
    ExhaustedError,
    LostError,
    changed,
    unpacked,
)
from scaffold.model.python.evaluation.given_arguments import given_argument
from scaffold.model.python.evaluation.list_changes import (
    CHANGING,
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
from scaffold.model.python.evaluation.returns import has_result, plain_function
from scaffold.model.python.evaluation.values import (
    FUNCTIONS,
    MAX_LENGTH,
    NAMED_VALUES,
    UNKNOWN,
    Glob,
    Lazy,
    Unknown,
    copied,
    held_small,
    is_hashable,
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
    origin: ast.expr | None = None
    """The expression in a function that made it, where its names have other values."""


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
Comprehension = ast.ListComp | ast.SetComp | ast.GeneratorExp | ast.DictComp

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
        self._frames = 0
        """The number of functions being executed."""
        self._origins: dict[int, tuple[object, ast.expr]] = {}
        """The pairs and lists that they made, by identity, and the expressions."""
        self._notes = _NO_NOTES
        self._methods: Mapping[type[ast.expr], Callable[..., object]] = {
            ast.Name: self._name,
            ast.Attribute: self._attribute,
            ast.Compare: self.comparison,
            ast.Subscript: self.subscript,
            **{kind: partial(value_of, self.evaluate) for kind, value_of in OPERATIONS.items()},
            ast.ListComp: self._comprehension,
            ast.SetComp: self._comprehension,
            ast.GeneratorExp: self._comprehension,
            ast.DictComp: self._comprehension,
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
        elif self._frames and isinstance(node, ast.Tuple | ast.List):
            self._origins[id(value)] = value, node
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
                    items.extend(self.element(node, item) for item in value)
                yield isinstance(value, list | tuple)

    def element(self, node: ast.expr, value: object) -> Element:
        """Return an item of a list that is the value of an expression."""
        _, origin = self._origins.get(id(value), (None, None))
        return Element(node, value, origin=origin)

    def _collect_named(self, node: ast.Name, items: list[Element], depth: int) -> Iterator[bool]:
        literal = list_literal(self.module, node)
        if literal is None:
            return
        yield from self._collect(literal, items, depth + 1)
        statement = statement_of(self.module, literal)
        scope = self.module.index.scope_of(node)
        for change in changes_of(self.module, node):
            straight = is_straight(self.module, statement, change)
            is_later = change.lineno > node.lineno
            if straight and is_later and scope is self.module.index.scope_of(change):
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

    def _comprehension(self, node: Comprehension) -> object:
        results: list[object] = []
        if not self._generate(node, node.generators, results):
            return UNKNOWN
        if not isinstance(node, ast.DictComp):
            return results
        pairs = [item for item in results if isinstance(item, tuple) and is_hashable(item[0])]
        return dict(pairs) if len(pairs) == len(results) else UNKNOWN

    def _generate(
        self, node: Comprehension, left: Sequence[ast.comprehension], results: list[object]
    ) -> bool:
        """Append the items that the remaining loops make; return whether they are known."""
        if not left:
            if isinstance(node, ast.DictComp):
                results.append((self.evaluate(node.key), self.evaluate(node.value)))
            else:
                results.append(self.evaluate(node.elt))
            return results[-1] is not UNKNOWN and len(results) <= MAX_LENGTH
        loop = left[0]
        values = self.evaluate(loop.iter)
        if isinstance(values, dict | Lazy):
            values = [*islice(values, MAX_LENGTH)]
        if not isinstance(values, list | tuple):
            return False
        for value in values:
            paths = self.paths(value) if isinstance(value, Glob) else None
            if isinstance(value, Glob) and (paths is None or not loop.ifs):
                kept = self._kept_pattern(node, loop, value)
                if kept is not None:
                    results.append(kept)
                    continue
            for item in [value] if paths is None else paths:
                if not self._generate_for(node, left, item, results):
                    return False
        return True

    def _generate_for(
        self,
        node: Comprehension,
        left: Sequence[ast.comprehension],
        item: object,
        results: list[object],
    ) -> bool:
        loop, *inner = left
        self._steps += 1
        if self._steps > self._most:
            self._is_cut = True
            return False
        with self._bound(node, _names_in(loop.target, item)):
            tests = [self.truth_of(self.evaluate(test)) for test in loop.ifs]
            return None not in tests and (not all(tests) or self._generate(node, inner, results))

    def _kept_pattern(
        self, node: Comprehension, loop: ast.comprehension, pattern: Glob
    ) -> Glob | None:
        """Return the pattern, if the items are the paths that match it, or some of them."""
        if isinstance(node, ast.DictComp) or loop is not node.generators[-1]:
            return None
        with self._bound(node, _names_in(loop.target, pattern)):
            item = self.evaluate(node.elt)
        if not isinstance(item, Glob):
            return None
        filtered = item.filtered or bool(loop.ifs)
        return Glob(item.pattern, recursive=item.recursive, filtered=filtered, is_path=item.is_path)

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
        if name is not None and name in FUNCTIONS:
            args = self._given(node)
            keywords = {word.arg or "**": self.evaluate(word.value) for word in node.keywords}
            return UNKNOWN if args is None else FUNCTIONS[name](args, keywords)
        if name == "os.path.join":
            return joined_path(self.evaluate, node)
        if isinstance(node.func, ast.Attribute) and name is None:
            value = method_result(self.evaluate, node, node.func)
            if value is not UNKNOWN:
                return value
        if self._frames and isinstance(node.func, ast.Attribute) and node.func.attr in CHANGING:
            holder = self.evaluate(node.func.value)
            if isinstance(holder, list | dict):
                given = [self.evaluate(arg) for arg in node.args]
                given += [UNKNOWN for word in node.keywords if word.arg != "key"]
                return changed(self, holder, node.func.attr, given)
        value = self.call(node)
        if value is UNKNOWN:
            value = self._result(node)
        if value is UNKNOWN and self._frames and name != "print":
            for arg in (*node.args, *(word.value for word in node.keywords)):
                self.forget(self.held(arg))
        return value

    def _result(self, node: ast.Call) -> object:
        """Return the value of a call of a function of the file."""
        function = plain_function(self.module, node.func)
        if function is None or not (self._frames or has_result(function)):
            return UNKNOWN
        signature = function.args
        parameters = (*signature.posonlyargs, *signature.args, *signature.kwonlyargs)
        given = {
            item.arg: self.evaluate(given_argument(function, node, item, is_method=False))
            for item in parameters
        }
        if signature.vararg is not None:
            further = self._given(node, len(signature.posonlyargs + signature.args))
            given[signature.vararg.arg] = UNKNOWN if further is None else further
        if not self._frames:  # values that are kept must not change
            given = {name: copied(value) for name, value in given.items()}
        outer = self._local
        with self._bound(function, {"": None, **given}), self._executing():
            execution = Execution(self)
            try:
                return execution.result_of(function)
            except (LostError, ExhaustedError):
                execution.forget_changes(function)
                return UNKNOWN
            finally:
                outer.update({key: self._local[key] for key in outer})

    def value_after(self, blocks: Iterable[Sequence[ast.stmt]], node: ast.expr) -> object:
        """Return the value of an expression of the module after the execution of blocks."""
        self._start()
        self._depth += 1
        execution = Execution(self)
        try:
            with self._bound(self.module.tree, {"": None}), self._executing():
                for block in blocks:
                    execution.run(block)
                return self.evaluate(node)
        except (LostError, ExhaustedError):
            return UNKNOWN
        finally:
            self._depth -= 1
            self._is_cut = False

    def _given(self, node: ast.Call, start: int = 0) -> Sequence[object] | None:
        """Return the arguments of a call from a place on; ``None`` if their number is unknown."""
        if any(isinstance(arg, ast.Starred) for arg in node.args[:start]):
            return None
        values = OPERATIONS[ast.Tuple](self.evaluate, ast.Tuple(node.args[start:], ast.Load()))
        return values if isinstance(values, tuple) else None

    @contextmanager
    def _executing(self) -> Iterator[None]:
        self._frames += 1
        try:
            yield
        finally:
            self._frames -= 1

    # -- for statements that are executed

    def items_of(self, value: object) -> Iterable[object] | None:
        """Return what a loop over a value runs through; ``None`` if unknown."""
        if isinstance(value, dict):
            return [*value]
        if not isinstance(value, list | tuple):
            return value if isinstance(value, Lazy) else None
        items: list[object] = []
        for item in value:
            paths = self.paths(item) if isinstance(item, Glob) else [item]
            if paths is None:
                return None
            items.extend(paths)
        return items

    def truth_of(self, value: object) -> bool | None:
        """Return whether a value is true; ``None`` if unknown."""
        if is_known(value):
            return bool(value)
        items = self.items_of(value) if isinstance(value, list) else None
        return None if items is None or UNKNOWN in items else bool(items)

    def assign(self, name: ast.Name, value: object) -> None:
        """Set the value of a name in the function being executed."""
        lookup = self.module.index.lookup(name.id, name)
        if lookup is not None:
            self._local[lookup[0], name.id] = value

    def held(self, node: ast.expr) -> object:
        """Return the value that was assigned to a name."""
        lookup = self.module.index.lookup(node.id, node) if isinstance(node, ast.Name) else None
        return self._local.get((lookup[0], lookup[1][0].name), UNKNOWN) if lookup else UNKNOWN

    def forget(self, value: object) -> None:
        """Make the content of a list or dictionary unknown."""
        if isinstance(value, list):
            value.append(UNKNOWN)
        elif isinstance(value, dict):
            value.update(dict.fromkeys(value, UNKNOWN))
            value[_UNKNOWN_KEY] = UNKNOWN

    def count_step(self) -> None:
        """Count a statement that is executed; raises ExhaustedError."""
        self._steps += 1
        if self._steps > self._most:
            self._is_cut = True
            raise ExhaustedError

    def paths(self, pattern: Glob) -> Sequence[object] | None:
        """Return the paths that match a pattern; ``None`` if the files are not known."""
        del pattern
        return None


_UNKNOWN_KEY = object()
"""A key of a dictionary that stands for others, which are unknown."""


def _names_in(target: ast.expr, value: object) -> dict[str, object]:
    """Return the values of the names in the target of a loop."""
    return {part.id: item for part, item in unpacked(target, value) if isinstance(part, ast.Name)}
