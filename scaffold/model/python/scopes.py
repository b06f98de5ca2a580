"""Scopes and bindings of names, from the syntax tree."""

from __future__ import annotations

import ast
from array import array
from bisect import bisect_left
from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from functools import partial
from operator import attrgetter
from typing import TypeVar, cast

from scaffold.record import NamedTuple

FunctionNode = ast.FunctionDef | ast.AsyncFunctionDef
_FUNCTIONS = (ast.FunctionDef, ast.AsyncFunctionDef)
_COMPREHENSIONS = (ast.ListComp, ast.SetComp, ast.DictComp, ast.GeneratorExp)
_SCOPES = frozenset({ast.Module, ast.ClassDef, ast.Lambda, *_FUNCTIONS, *_COMPREHENSIONS})

_LEAVES = frozenset(
    {ast.Constant, ast.Name, ast.alias, ast.Pass, ast.Break, ast.Continue, ast.Global}
    | {ast.Nonlocal, ast.MatchSingleton, ast.MatchStar}
)
_NOT_NODES = frozenset(
    {"ctx", "op", "ops", "attr", "arg", "asname", "type_comment", "level", "module", "conversion"}
    | {"is_async", "simple", "type_ignores", "rest", "kwd_attrs"}
)
"""Fields without nodes, or with shared nodes (operators, contexts) without locations."""

Node = TypeVar("Node", bound=ast.AST)

_STATEMENTS = frozenset({ast.Module, *ast.stmt.__subclasses__()})
_PLACE = attrgetter("lineno", "col_offset")

MOST_BINDINGS = 200
"""The maximum number of bindings of a name in a scope; with more its value is unknown."""


class Binding(NamedTuple):
    """A place that binds a name."""

    name: str
    kind: str
    """``import``, ``function``, ``class``, ``assignment``, ``annotation`` (without a value),
    ``augmented``, ``parameter``, ``loop``, ``deletion`` or ``other``."""
    node: ast.AST
    value: ast.expr | None = None
    """The assigned value, if literal."""
    target: str = ""
    """For an import: the full dotted name, with leading dots."""


class ScopeIndex:
    """An index of the nodes of a module: by type, with parents and scopes."""

    def __init__(self, tree: ast.Module) -> None:
        self.tree = tree
        self._parents: dict[ast.AST, ast.AST] = {}
        self._nodes: list[ast.AST] = []
        """All nodes in preorder."""
        self._spans: dict[ast.AST, tuple[int, int]] = {}
        """The index ranges of statements."""
        self._numbers: defaultdict[type[ast.AST], array[int]] = defaultdict(partial(array, "I"))
        """The indices of nodes by type."""
        self._by_type: dict[type[ast.AST], list[ast.AST]] = {}
        self._sorted: dict[type[ast.AST], Sequence[ast.AST]] = {}
        self._scopes: dict[ast.AST, dict[str, list[Binding]]] | None = None
        self._around: dict[ast.AST, ast.AST] = {tree: tree}
        self._looked_up: dict[tuple[str, ast.AST], tuple[ast.AST, Sequence[Binding]] | None] = {}
        self._blocks: dict[ast.AST, dict[ast.AST, tuple[str, int]]] = {}
        self._names: dict[str, list[ast.Name]] | None = None
        self._attributes: dict[str, list[ast.Attribute]] | None = None

    def build(self, deepest: int) -> bool:
        """Visit all nodes; return false if they are nested too deeply."""
        return self._visit(self.tree, deepest - 1)

    def _visit(self, node: ast.AST, levels: int) -> bool:
        """Number a node and its descendants; return false if they are nested too deeply.

        A method, as a nested function would keep the tree in a reference cycle.
        """
        parents, numbers, nodes = self._parents, self._numbers, self._nodes
        kind = type(node)
        first = len(nodes)
        nodes.append(node)
        numbers[kind].append(first)
        for field in _FIELDS[kind]:
            value = getattr(node, field, None)
            for item in value if type(value) is list else (value,):
                if not isinstance(item, ast.AST):
                    continue
                parents[item] = node
                if not levels:
                    return False
                inner = type(item)
                if not _FIELDS[inner]:  # half of all nodes: avoid a call for each
                    numbers[inner].append(len(nodes))
                    nodes.append(item)
                elif not self._visit(item, levels - 1):
                    return False
        if kind in _STATEMENTS:
            self._spans[node] = first, len(nodes)
        return True

    @property
    def nodes(self) -> Sequence[ast.AST]:
        """All nodes in preorder."""
        return self._nodes

    def below(self, node: ast.AST, *kinds: type[Node]) -> Iterator[Node]:
        """Yield a node and its descendants of some types, one type after the other.

        The node may be of another module, such as the method of a base class.
        """
        span = self._spans.get(node)
        if span is None:
            inside = [*_preorder(node)]
            for kind in kinds:
                yield from (inner for inner in inside if type(inner) is kind)
            return
        for kind in kinds:
            numbers = self._numbers.get(kind, ())
            start, end = bisect_left(numbers, span[0]), bisect_left(numbers, span[1])
            yield from self._of_type(kind)[start:end]

    def _of_type(self, kind: type[Node]) -> list[Node]:
        """Return the nodes of a type in preorder."""
        if kind not in self._by_type:
            self._by_type[kind] = [self._nodes[number] for number in self._numbers.get(kind, ())]
        return cast("list[Node]", self._by_type[kind])

    def of_types(self, *kinds: type[Node]) -> Iterator[Node]:
        """Yield the nodes of some types, one type after the other, in preorder."""
        for kind in kinds:
            yield from self._of_type(kind)

    def all_of(self, kind: type[Node]) -> Sequence[Node]:
        """Return the nodes of a type in the order of the text."""
        if kind not in self._sorted:
            nodes = self._of_type(kind)
            has_places = bool(nodes) and hasattr(nodes[0], "lineno")
            self._sorted[kind] = sorted(nodes, key=_PLACE) if has_places else nodes
        return cast("Sequence[Node]", self._sorted[kind])

    def names(self, name: str) -> Sequence[ast.Name]:
        """Return the uses of a name in all scopes, in the order of the text."""
        if self._names is None:
            self._names = {}
            for node in self.all_of(ast.Name):
                self._names.setdefault(node.id, []).append(node)
        return self._names.get(name, ())

    def attributes(self, name: str) -> Sequence[ast.Attribute]:
        """Return the uses of an attribute of this name on any object."""
        if self._attributes is None:
            self._attributes = {}
            for node in self.all_of(ast.Attribute):
                self._attributes.setdefault(node.attr, []).append(node)
        return self._attributes.get(name, ())

    def parent(self, node: ast.AST) -> ast.AST | None:
        """Return the parent of a node."""
        return self._parents.get(node)

    def parents(self, node: ast.AST) -> Iterator[ast.AST]:
        """Yield the ancestors of a node, from the inside out."""
        parent = self._parents.get(node)
        while parent is not None:
            yield parent
            parent = self._parents.get(parent)

    def place(self, statement: ast.AST) -> tuple[str, int]:
        """Return the block with a statement in its parent, and its index there.

        The block is ``body``, ``orelse``, ``finalbody`` or ``handlers``; empty, with a number of
        -1, for a node that is in no block.
        """
        parent = self._parents.get(statement)
        if parent is None:
            return "", -1
        if parent not in self._blocks:
            self._blocks[parent] = _places(parent)
        return self._blocks[parent].get(statement, ("", -1))

    # -- scopes

    def scope_of(self, node: ast.AST) -> ast.AST:
        """Return the scope that a node is evaluated in: a module, class, function ..."""
        scope = self._around.get(node)
        return self._find_scope(node) if scope is None else scope

    def _find_scope(self, node: ast.AST) -> ast.AST:
        around, parents = self._around, self._parents
        inside: list[ast.AST] = []
        while node not in around:
            inside.append(node)
            parent = parents.get(node, self.tree)
            if type(parent) in _SCOPES and _is_inside(parent, node):
                around[node] = parent
            elif type(parent) is ast.comprehension and self._is_first_iterable(parent, node):
                node = parents[parent]
            else:
                node = parent
        scope = around[node]
        around.update(dict.fromkeys(inside, scope))
        return scope

    def _is_first_iterable(self, generator: ast.comprehension, node: ast.AST) -> bool:
        """Return whether a node is the first iterable of a comprehension, evaluated outside."""
        if node is not generator.iter:
            return False
        holder = self._parents[generator]
        return isinstance(holder, _COMPREHENSIONS) and holder.generators[0] is generator

    def bindings(self, scope: ast.AST) -> Mapping[str, Sequence[Binding]]:
        """Return the own bindings of a scope, by name."""
        if self._scopes is None:
            self._scopes = {}
            for owner, binding in self._all_bindings():
                bindings = self._scopes.setdefault(owner, {}).setdefault(binding.name, [])
                if len(bindings) < MOST_BINDINGS:
                    bindings.append(binding)
                elif len(bindings) == MOST_BINDINGS:
                    bindings.append(Binding(binding.name, "other", binding.node))
        return self._scopes.get(scope, {})

    def lookup(self, name: str, at: ast.AST) -> tuple[ast.AST, Sequence[Binding]] | None:
        """Return the scope of a name used at a node, and its bindings there."""
        key = name, self.scope_of(at)
        if key not in self._looked_up:
            self._looked_up[key] = self._look_up(*key)
        return self._looked_up[key]

    def bindings_of(self, node: ast.AST | None) -> Sequence[Binding]:
        """Return what binds the name that an expression is; nothing for other expressions."""
        binding = self.lookup(node.id, node) if isinstance(node, ast.Name) else None
        return binding[1] if binding else ()

    def only_node(self, node: ast.AST | None) -> ast.AST | None:
        """Return the node that binds a name, if it is bound only once."""
        bindings = self.bindings_of(node)
        return bindings[0].node if len(bindings) == 1 else None

    def only_value(self, node: ast.AST | None) -> ast.expr | None:
        """Return the value of a name that is bound only once; ``None`` for other expressions."""
        bindings = self.bindings_of(node)
        return bindings[0].value if len(bindings) == 1 else None

    def uses_of(self, variable: ast.Name) -> Sequence[ast.Name]:
        """Return where the same variable is set or read, here among them; none if unknown."""
        binding = self.lookup(variable.id, variable)
        uses = self.names(variable.id) if binding is not None else ()
        return [use for use in uses if self.lookup(use.id, use) == binding]

    def _look_up(self, name: str, scope: ast.AST) -> tuple[ast.AST, Sequence[Binding]] | None:
        first = True
        while True:
            # Names of a class body are only visible in the body, not in its functions.
            if first or not isinstance(scope, ast.ClassDef):
                bindings = self.bindings(scope).get(name)
                if bindings:
                    return scope, bindings
            if isinstance(scope, ast.Module):
                return None
            first = False
            scope = self.scope_of(scope)

    def _all_bindings(self) -> Iterator[tuple[ast.AST, Binding]]:
        redirected = self._redirected_names()
        for owner, binding in self._own_bindings():
            yield redirected.get((owner, binding.name), owner), binding

    def _redirected_names(self) -> dict[tuple[ast.AST, str], ast.AST]:
        """Return the names of functions bound elsewhere: ``global``, ``nonlocal``."""
        redirected: dict[tuple[ast.AST, str], ast.AST] = {}
        for declared in self.all_of(ast.Global):
            scope = self.scope_of(declared)
            redirected.update({(scope, name): self.tree for name in declared.names})
        for shared in self.all_of(ast.Nonlocal):
            scope = self.scope_of(shared)
            outer = self._enclosing_function_scope(scope)
            redirected.update({(scope, name): outer for name in shared.names})
        return redirected

    def _enclosing_function_scope(self, scope: ast.AST) -> ast.AST:
        for parent in self.parents(scope):
            if isinstance(parent, _FUNCTIONS):
                return parent
        return self.tree

    def _own_bindings(self) -> Iterator[tuple[ast.AST, Binding]]:
        functions: list[FunctionNode] = [
            *self.all_of(ast.FunctionDef),
            *self.all_of(ast.AsyncFunctionDef),
        ]
        for function in functions:
            yield self.scope_of(function), Binding(function.name, "function", function)
        for class_ in self.all_of(ast.ClassDef):
            yield self.scope_of(class_), Binding(class_.name, "class", class_)
        for arg in self.all_of(ast.arg):
            yield self._parents[self._parents[arg]], Binding(arg.arg, "parameter", arg)
        imports: list[ast.Import | ast.ImportFrom] = [
            *self.all_of(ast.Import),
            *self.all_of(ast.ImportFrom),
        ]
        for import_ in imports:
            scope = self.scope_of(import_)
            for binding in _imported(import_):
                yield scope, binding
        for name in self.all_of(ast.Name):
            if not isinstance(name.ctx, ast.Load):
                yield self._scope_of_target(name), self._of_target(name)
        yield from self._rare_bindings()

    def _rare_bindings(self) -> Iterator[tuple[ast.AST, Binding]]:
        for kind_name in ("ExceptHandler", "MatchAs", "MatchStar", "TypeVar", "ParamSpec"):
            for node in self.all_of(getattr(ast, kind_name, ast.AST)):
                name = getattr(node, "name", None)
                if name:
                    yield self.scope_of(node), Binding(name, "other", node)
        for mapping in self.all_of(ast.MatchMapping):
            if mapping.rest:
                yield self.scope_of(mapping), Binding(mapping.rest, "other", mapping)

    def _scope_of_target(self, node: ast.Name) -> ast.AST:
        scope = self.scope_of(node)
        if isinstance(self.parent(node), ast.NamedExpr):
            while isinstance(scope, _COMPREHENSIONS):
                scope = self.scope_of(scope)
        return scope

    def _of_target(self, node: ast.Name) -> Binding:
        """Return the binding of a name that is a target."""
        if isinstance(node.ctx, ast.Del):
            return Binding(node.id, "deletion", node)
        parent = self.parent(node)
        kind = "other"
        value: ast.expr | None = None
        match parent:
            case ast.AnnAssign(value=None):
                kind = "annotation"
            case ast.Assign() | ast.AnnAssign() | ast.NamedExpr():
                kind, value = "assignment", parent.value
            case ast.AugAssign():
                kind = "augmented"
            case ast.For() | ast.AsyncFor() | ast.comprehension():
                kind = "loop"
            case ast.Tuple() | ast.List():
                kind, value = self._unpacked(node, parent)
        return Binding(node.id, kind, node, value)

    def _unpacked(
        self, node: ast.Name, targets: ast.Tuple | ast.List
    ) -> tuple[str, ast.expr | None]:
        """Pair ``a, b = 1, 2`` if both sides are literal."""
        above = self.parent(targets)
        if not isinstance(above, ast.Assign):
            return "other", None
        values = above.value
        starred = any(isinstance(item, ast.Starred) for item in targets.elts)
        if (
            starred
            or not isinstance(values, ast.Tuple | ast.List)
            or len(values.elts) != len(targets.elts)
            or any(isinstance(item, ast.Starred) for item in values.elts)
        ):
            return "other", None
        return "assignment", values.elts[targets.elts.index(node)]


def _places(parent: ast.AST) -> dict[ast.AST, tuple[str, int]]:
    result: dict[ast.AST, tuple[str, int]] = {}
    for field in ("body", "orelse", "finalbody", "handlers"):
        block = getattr(parent, field, None)
        if isinstance(block, list):
            result.update((item, (field, number)) for number, item in enumerate(block))
    return result


def _preorder(node: ast.AST) -> Iterator[ast.AST]:
    """Yield a node and its descendants in preorder."""
    pending = [node]
    while pending:
        node = pending.pop()
        yield node
        pending += reversed([*children(node)])


def children(node: ast.AST) -> Iterator[ast.AST]:
    """Yield the children of a node, without contexts and operators."""
    for field in _FIELDS[type(node)]:
        value = getattr(node, field, None)
        for item in value if type(value) is list else (value,):
            if isinstance(item, ast.AST):
                yield item


class _Fields(dict[type[ast.AST], tuple[str, ...]]):
    """The fields of a node type with nodes to visit."""

    def __missing__(self, kind: type[ast.AST]) -> tuple[str, ...]:
        names = () if kind in _LEAVES else tuple(f for f in kind._fields if f not in _NOT_NODES)
        self[kind] = names
        return names


_FIELDS = _Fields()


def _is_inside(scope: ast.AST, child: ast.AST) -> bool:
    """Return whether a child of a scope is evaluated inside of it."""
    match scope:
        case ast.FunctionDef() | ast.AsyncFunctionDef() | ast.ClassDef():
            return isinstance(child, ast.stmt)
        case ast.Lambda(body=body):
            return child is body
        case _:
            return True


def _imported(node: ast.Import | ast.ImportFrom) -> Iterator[Binding]:
    if isinstance(node, ast.Import):
        for alias in node.names:
            target = alias.name if alias.asname else alias.name.partition(".")[0]
            yield Binding(alias.asname or target, "import", alias, None, target)
    else:
        prefix = "." * node.level + (node.module or "")
        for alias in node.names:
            dot = "" if prefix.endswith(".") else "."
            name = alias.asname or alias.name
            yield Binding(name, "import", alias, None, f"{prefix}{dot}{alias.name}")
