"""Static evaluation of attributes of ``self``, from their assignments."""

from __future__ import annotations

import ast
from collections.abc import Callable, Iterable, Iterator, Sequence
from itertools import islice
from typing import TYPE_CHECKING

from scaffold.model.python.evaluation.elements import looped_element, only_element
from scaffold.model.python.evaluation.evaluator import MOST_ASSIGNMENTS, Evaluator
from scaffold.model.python.evaluation.values import is_none_literal
from scaffold.record import NamedTuple

if TYPE_CHECKING:
    from scaffold.model.python.module import PythonModule


_MAX_DEPTH = 10
"""The maximum number of names to follow."""


class Store(NamedTuple):
    """An assignment to an attribute."""

    node: ast.Attribute
    class_: ast.ClassDef | None
    """The class of the ``self`` with the attribute."""
    value: ast.expr | None


class AttributeEvaluator(Evaluator):
    """An evaluator that knows the assignments of attributes.

    Args:
        module: The file.
        related: Returns a class together with its bases and subclasses in the file.
    """

    def __init__(
        self, module: PythonModule, related: Callable[[ast.ClassDef], Sequence[ast.ClassDef]]
    ) -> None:
        super().__init__(module)
        self.related = related
        self._stores: dict[str, list[Store]] | None = None
        self._classes: dict[tuple[str, ast.AST], ast.ClassDef | None] = {}
        """By name and scope."""
        self._values: dict[tuple[ast.ClassDef, str], Sequence[ast.expr] | None] = {}
        self._single: dict[ast.expr | tuple[str, ast.AST], ast.expr | None] = {}
        """Single values by name and scope, or by attribute; ``None`` if there is no other."""

    def self_class(self, node: ast.expr) -> ast.ClassDef | None:
        """Return the class of the instance in a name such as ``self``."""
        if not isinstance(node, ast.Name):
            return None
        key = node.id, self.module.index.scope_of(node)
        if key not in self._classes:
            self._classes[key] = self._class_of(node)
        return self._classes[key]

    def _class_of(self, node: ast.Name) -> ast.ClassDef | None:
        lookup = self.module.index.lookup(node.id, node)
        if lookup is None or [binding.kind for binding in lookup[1]] != ["parameter"]:
            return None
        function, parameter = lookup[0], lookup[1][0].node
        class_ = self.module.parent(function)
        if not isinstance(function, ast.FunctionDef | ast.AsyncFunctionDef):
            return None
        if not isinstance(class_, ast.ClassDef) or _is_static(function):
            return None
        first = [*function.args.posonlyargs, *function.args.args][:1]
        return class_ if first == [parameter] else None

    def stores(self, name: str) -> Sequence[Store]:
        """Return the assignments to an attribute of this name on any object."""
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
        """Return all values of ``self.name``; ``None`` if unknown."""
        class_ = self.self_class(node.value) or self.named_class(node.value)
        if class_ is None:
            return None
        key = class_, node.attr
        if key not in self._values:
            self._values[key] = self._values_of(*key)
        return self._values[key]

    def _values_of(self, class_: ast.ClassDef, name: str) -> Sequence[ast.expr] | None:
        stores = self.stores(name)
        if len(stores) > MOST_ASSIGNMENTS:
            return None
        family = self.related(class_)
        values: list[ast.expr] = []
        for store in stores:
            if store.class_ is not None and store.class_ not in family:
                continue
            if isinstance(store.node.value, ast.Attribute) and store.node.value.attr == "header":
                continue  # of a message: `image.header.stamp`
            if store.class_ is None or store.value is None or self._is_only_default(store.node):
                return None
            values.append(store.value)
        for member in family:
            for binding in self.module.index.bindings(member).get(name, ()):
                if binding.kind == "annotation":
                    continue
                if binding.value is None:
                    return None
                values.append(binding.value)
        return values

    def _is_only_default(self, target: ast.Attribute) -> bool:
        """Return whether other code may set an attribute: ``if not hasattr(self, 'rate'):``."""
        if not self.module.mentions("hasattr"):
            return False
        for parent in self.module.parents(target):
            if isinstance(parent, ast.If):
                for call in self.module.below(parent.test, ast.Call):
                    match call:
                        case ast.Call(
                            func=ast.Name("hasattr"), args=[_, ast.Constant(value=name)]
                        ) if name == target.attr:
                            return True
        return False

    def named_class(self, node: ast.expr) -> ast.ClassDef | None:
        """Return the class of the file that an expression refers to."""
        class_ = self.module.index.only_node(node)
        return class_ if isinstance(class_, ast.ClassDef) else None

    def single_value(self, node: ast.expr) -> ast.expr:
        """Follow names and attributes of ``self`` with a single assignment to its value.

        ``None`` is ignored, as users of the object wait for the other assignment.
        """
        key: ast.expr | tuple[str, ast.AST] = node
        if isinstance(node, ast.Name):
            key = node.id, self.module.index.scope_of(node)
        elif not isinstance(node, ast.Attribute | ast.Subscript):
            return node
        if key not in self._single:
            value = self._follow(node)
            self._single[key] = None if value is node else value
        return self._single[key] or node

    def values(self, node: ast.Name | ast.Attribute) -> Sequence[ast.expr]:
        """Return all values assigned to a name or an attribute of ``self``, except ``None``.

        It is empty if the name may have other values, such as an argument.
        """
        if isinstance(node, ast.Attribute):
            stored: Sequence[ast.expr | None] = self.attribute_values(node) or ()
        else:
            bindings = [x for x in self.module.index.bindings_of(node) if x.kind != "annotation"]
            is_open = any(x.kind != "assignment" for x in bindings)
            is_open = is_open or len(bindings) > MOST_ASSIGNMENTS
            stored = () if is_open else [binding.value for binding in bindings]
        values = [value for value in stored if value is not None and not is_none_literal(value)]
        return values if None not in stored else ()

    def origins(self, node: ast.expr, depth: int = 0) -> Sequence[ast.expr]:
        """Return all possible origins of a value, through names and attributes.

        Without ``None``; unknown expressions, such as arguments, are returned unchanged.
        """
        values: Sequence[ast.expr] = ()
        if isinstance(node, ast.IfExp):
            values = (node.body, node.orelse)
        elif isinstance(node, ast.Name | ast.Attribute):
            values = self.values(node)
        if not values or depth > _MAX_DEPTH:
            return (node,)
        sources = [item for value in values for item in self.origins(value, depth + 1)]
        return list(dict.fromkeys(sources))

    def _follow(self, node: ast.expr) -> ast.expr:
        for _ in range(10):
            values: Iterable[ast.expr | None] | None = None
            if isinstance(node, ast.Name):
                values = self._bindings(node)
            elif isinstance(node, ast.Attribute):
                values = self.attribute_values(node)
            elif isinstance(node, ast.Subscript) and not isinstance(node.slice, ast.Slice):
                values = [only_element(self.module, node.value, self.single_value)]
            made = list(islice((value for value in values or () if not is_none_literal(value)), 2))
            if len(made) != 1 or made[0] is None:
                return node
            node = made[0]
        return node

    def _bindings(self, node: ast.Name) -> Iterator[ast.expr | None]:
        """Yield the values of a name; the element of a container for the variable of a loop."""
        bindings = [x for x in self.module.index.bindings_of(node) if x.kind != "annotation"]
        for binding in bindings:
            is_loop = binding.value is None and len(bindings) == 1
            value = looped_element(self.module, binding, self.single_value) if is_loop else None
            yield value or binding.value


def _is_static(function: ast.FunctionDef | ast.AsyncFunctionDef) -> bool:
    return any(
        isinstance(decorator, ast.Name) and decorator.id in {"staticmethod", "classmethod"}
        for decorator in function.decorator_list
    )
