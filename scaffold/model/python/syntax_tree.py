"""The syntax tree of a Python file, with locations and qualified names."""

from __future__ import annotations

import ast
import builtins
from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property
from typing import TYPE_CHECKING, TypeVar

from scaffold import distributions
from scaffold.model.python.bounds import why_unchecked
from scaffold.model.python.parsing import BOM, Positions, decode, parse_tree, past_target
from scaffold.model.python.scopes import FunctionNode, Node, ScopeIndex
from scaffold.source import Location, ParseError, Source, TooLargeError

if TYPE_CHECKING:
    from typing_extensions import Self

Parsed = TypeVar("Parsed", bound="SyntaxTree")

_DEFAULTS_OF_TYPES = (3, 13)
"""The version whose type parameters may have defaults."""
MAX_DEPTH = 300
"""The depth limit of syntax trees; real modules stay below 50, and visitors recurse."""
_NO_NAMES = frozenset[str]()
"""Shared, as most expressions have none, and Python makes a new empty set each time."""


class SyntaxTree:
    """A parsed Python file: its nodes, their locations, and their qualified names."""

    def __init__(self, source: Source, tree: ast.Module, index: ScopeIndex) -> None:
        self.source = source
        self.path = source.path
        self.tree = tree
        self.index = index
        self._positions = Positions(source)
        self._names: dict[ast.AST, frozenset[str]] = {}
        """The cached full names of expressions."""
        self._roots: dict[tuple[str, ast.AST], frozenset[str]] = {}
        """The imported full names of names, by scope."""
        self._attributes: dict[tuple[frozenset[str], str], frozenset[str]] = {}
        """The full names of attributes, by those of their roots and the rest."""
        self._words: dict[ast.expr, frozenset[str]] = {}
        self._mentions: dict[str, bool] = {}

    @classmethod
    def parse(cls, source: Source) -> Self:
        """Parse a file.

        Raises:
            ParseError: it is not Python, or nested too deeply.
            TooLargeError: it has more code than people write.
            NewerSyntaxError: only a newer Python than the running one can parse it.
        """
        positions = Positions(source)
        tree = parse_tree(source, positions)
        index = ScopeIndex(tree)
        if not index.build(MAX_DEPTH):
            raise ParseError(Location.start_of(source.path), "nested too deeply")
        if reason := why_unchecked(index):
            raise TooLargeError(Location.start_of(source.path), reason)
        module = cls(source, tree, index)
        module._refuse_later_syntax()
        return module

    @classmethod
    def parse_bytes(cls, path: str, data: bytes) -> Self:
        """Decode a file by its coding cookie and parse it; raises like ``parse``."""
        return cls.parse(decode(path, data))

    def _refuse_later_syntax(self) -> None:
        """Reject syntax that the target's Python lacks, if a later one runs this tool."""
        if distributions.target().python >= _DEFAULTS_OF_TYPES:
            return
        type_var: type[ast.AST] | None = getattr(ast, "TypeVar", None)
        for node in self.walk(type_var) if type_var else ():
            if getattr(node, "default_value", None) is not None:
                raise ParseError(self.location(node), past_target(_DEFAULTS_OF_TYPES))

    # -- nodes and places

    def walk(self, kind: type[Node]) -> Sequence[Node]:
        """Return all nodes of exactly this type, in the order of the text."""
        return self.index.all_of(kind)

    def below(self, node: ast.AST, *kinds: type[Node]) -> Iterator[Node]:
        """Yield a node and its descendants of some types, one type after the other."""
        return self.index.below(node, *kinds)

    @cached_property
    def function_nodes(self) -> Sequence[FunctionNode]:
        """All functions and methods, nested ones too, in the order of the text."""
        nodes: list[FunctionNode] = [
            *self.walk(ast.FunctionDef),
            *self.walk(ast.AsyncFunctionDef),
        ]
        return sorted(nodes, key=lambda node: (node.lineno, node.col_offset))

    def parent(self, node: ast.AST) -> ast.AST | None:
        """Return the parent of a node."""
        return self.index.parent(node)

    def parents(self, node: ast.AST) -> Iterator[ast.AST]:
        """Yield the ancestors of a node, from the inside out."""
        return self.index.parents(node)

    def is_inside(self, node: ast.AST, scope: ast.AST) -> bool:
        """Return whether a node is a descendant of another one."""
        return any(parent is scope for parent in self.parents(node))

    def enclosing(self, node: ast.AST, *kinds: type[Node]) -> Node | None:
        """Return the innermost ancestor of some types."""
        return next((parent for parent in self.parents(node) if isinstance(parent, kinds)), None)

    def enclosing_function(self, node: ast.AST) -> FunctionNode | None:
        """Return the function around a node, ignoring lambdas."""
        for parent in self.parents(node):
            if isinstance(parent, ast.FunctionDef | ast.AsyncFunctionDef):
                return parent
        return None

    def enclosing_class(self, node: ast.AST) -> ast.ClassDef | None:
        """Return the innermost class around a node."""
        return self.enclosing(node, ast.ClassDef)

    def call_with(self, function: ast.AST) -> ast.Call | None:
        """Return the call whose function an expression is: ``talk()`` for ``talk``."""
        call = self.parent(function)
        return call if isinstance(call, ast.Call) and call.func is function else None

    def method_calls(self, *names: str) -> Iterator[tuple[ast.Call, ast.Attribute]]:
        """Yield the calls of methods with these names on any object, each with its function."""
        for name in names:
            for method in self.index.attributes(name):
                if call := self.call_with(method):
                    yield call, method

    def calls_of(self, *functions: str) -> Sequence[ast.Call]:
        """Return the calls of functions that certainly have these full names; see `qualified_name`.

        They are in source order, or by name for several names.
        """
        return [call for function in functions for call in self._calls.get(function, ())]

    @cached_property
    def _calls(self) -> Mapping[str, Sequence[ast.Call]]:
        """The calls by the full name of the function."""
        result: dict[str, list[ast.Call]] = {}
        for call in self.walk(ast.Call):
            name = self.qualified_name(call.func)
            if name is not None:
                result.setdefault(name, []).append(call)
        return result

    def span(self, node: ast.AST) -> tuple[int, int]:
        """Return the start and end offsets of a node.

        Inside an f-string it is the whole string, as before Python 3.12.
        """
        around: ast.AST | None = node
        while around is not None and not isinstance(around, ast.stmt):
            if isinstance(around, ast.JoinedStr):
                node = around
            around = self.parent(around)
        while not hasattr(node, "lineno"):
            above = self.parent(node)
            if above is None:
                return 0, len(self.source.text)
            node = above
        start = self._positions.offset(node.lineno, getattr(node, "col_offset", 0))
        end_line = getattr(node, "end_lineno", None) or node.lineno
        end = self._positions.offset(end_line, getattr(node, "end_col_offset", None) or 0)
        return start, max(start, end)

    def location(self, node: ast.AST) -> Location:
        """Return the place of a node, with columns in characters."""
        return self.source.location(*self.span(node))

    def exact_location(self, node: ast.AST) -> Location:
        """Return the location of a node, also inside an f-string if the parser is right.

        Before Python 3.12 it may be wrong, for example in a multiline string.
        """
        whole = self.location(node)
        if not isinstance(node, ast.expr) or isinstance(node, ast.JoinedStr):
            return whole
        start = self._positions.offset(node.lineno, node.col_offset)
        end = self._positions.offset(node.end_lineno or node.lineno, node.end_col_offset or 0)
        exact = self.source.location(start, max(start, end))
        return exact if exact == whole or self._reads_as(node, start, end) else whole

    def _reads_as(self, node: ast.expr, start: int, end: int) -> bool:
        """Return whether a part of the text is an expression."""
        try:
            parsed = ast.parse(self.source.text[start:end].strip(), mode="eval")
        except (SyntaxError, ValueError):
            return False
        return ast.dump(parsed.body) == ast.dump(node)

    def name_location(self, node: FunctionNode | ast.ClassDef) -> Location:
        """Return the place of the name after ``def`` or ``class``."""
        start, _ = self.span(node)
        at = self.source.text.find(node.name, self.source.text.find(" ", start))
        if isinstance(node, ast.AsyncFunctionDef):
            at = self.source.text.find(node.name, self.source.text.find("def", start + 5) + 3)
        if at < 0:  # the parser normalizes names, so the text may differ
            return self.source.location(start, start)
        return self.source.location(at, at + len(node.name))

    def text(self, node: ast.AST) -> str:
        """Return a node as written."""
        start, end = self.span(node)
        return self.source.text[start:end]

    def words_of(self, condition: ast.expr) -> frozenset[str]:
        """Return the names and attributes in a condition as text: ``self.topic``."""
        if condition not in self._words:
            self._words[condition] = frozenset(
                ast.unparse(item)
                for item in ast.walk(condition)
                if isinstance(item, ast.Name | ast.Attribute)
            )
        return self._words[condition]

    def mentions(self, *texts: str) -> bool:
        """Return whether the file contains any of some texts; results are cached."""
        mentions = self._mentions
        for text in texts:
            if text not in mentions:
                mentions[text] = text in self.source.text
        return any(mentions[text] for text in texts)

    # -- names

    def qualified_name(self, node: ast.AST) -> str | None:
        """Return the full dotted name of an expression, through the imports in its scope.

        ``Node`` becomes ``rclpy.node.Node``; an unbound name is a builtin and is
        unchanged; relative imports keep their dots. ``None`` for names defined in the module
        and for unknown ones.
        """
        names = self.qualified_names(node)
        if len(names) != 1:
            return None
        (name,) = names
        return name

    def qualified_names(self, node: ast.AST) -> frozenset[str]:
        """Return all possible full names of an expression: imports in ``try`` give several.

        Empty for names defined in the module and for unknown ones.
        """
        result = self._names.get(node)
        if result is None:
            result = self._names[node] = self._find_names(node)
        return result

    def _find_names(self, node: ast.AST) -> frozenset[str]:
        parts = ""
        while isinstance(node, ast.Attribute):
            parts = f".{node.attr}{parts}"
            node = node.value
        if not isinstance(node, ast.Name):
            return _NO_NAMES
        if node.id not in self._imported_names and not hasattr(builtins, node.id):
            return _NO_NAMES
        key = node.id, self.index.scope_of(node)
        if key not in self._roots:
            self._roots[key] = self._imported_as(node)
        roots = self._roots[key]
        if not parts or not roots:
            return roots
        whole = roots, parts
        if whole not in self._attributes:
            self._attributes[whole] = frozenset(
                root + (parts[1:] if root.endswith(".") else parts) for root in roots
            )
        return self._attributes[whole]

    @cached_property
    def _imported_names(self) -> frozenset[str]:
        """All names bound by imports."""
        aliases = self.walk(ast.alias)
        return frozenset(item.asname or item.name.partition(".")[0] for item in aliases)

    def _imported_as(self, node: ast.Name) -> frozenset[str]:
        lookup = self.index.lookup(node.id, node)
        if lookup is None:
            # A star import may bind open or sum, but not KeyboardInterrupt.
            is_star = "*" in self.index.bindings(self.tree) and node.id.islower()
            is_builtin = hasattr(builtins, node.id) and not is_star
            return frozenset({node.id}) if is_builtin else _NO_NAMES
        if any(binding.kind != "import" for binding in lookup[1]):
            return _NO_NAMES
        return frozenset(binding.target for binding in lookup[1])

    @property
    def has_bom(self) -> bool:
        """Whether the file starts with a byte order mark."""
        return self.source.text.startswith(BOM)
