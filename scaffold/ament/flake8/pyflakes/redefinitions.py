"""F811: a name is bound again before it was used, followed the way pyflakes does.

ruff's F811 looks at fewer kinds of bindings. The walk keeps, for each scope, what a name is bound
to and whether it was used since; bodies of functions are walked after their module, as they run
after it. It only starts when a scope binds some name twice, one of them by a definition.
"""

from __future__ import annotations

import ast
import builtins
from collections import Counter
from collections.abc import Callable, Iterator, Sequence

from scaffold.ament import linters
from scaffold.ament.finding import Finding
from scaffold.ament.python_text.text import PythonText
from scaffold.model.python.scopes import ScopeIndex, children

ASSIGNED, DEFINED, IMPORTED, SUBMODULE, ANNOTATED, BOUND = range(6)
"""BOUND: an argument, a loop variable, an element of a tuple that is unpacked."""

_MAGIC = ("__file__", "__builtins__", "__annotations__", "WindowsError")
"""Names that every module has."""

_Function = (ast.FunctionDef, ast.AsyncFunctionDef)
_Comprehension = (ast.ListComp, ast.SetComp, ast.DictComp, ast.GeneratorExp)


def check(text: PythonText) -> Iterator[Finding]:
    """Yield the definitions, imports and assignments that replace something unused."""
    if text.index is None:
        return
    aliased = _repeated_aliases(text)
    if aliased or _is_worth_a_walk(text):
        walk = _Walk(text.index)
        for node, name, line in walk.run():
            message = f"'{name}' is defined again; its definition in line {line} was never used"
            yield Finding("F811", node.lineno, text.column(node.lineno, node.col_offset), message)
        for name, node in walk.unused_imports():
            if (name, node) in aliased:
                column = text.column(node.lineno, node.col_offset)
                yield Finding("F401", node.lineno, column, f"`{name}` imported but unused")


Place = ast.stmt | ast.ExceptHandler | ast.arg | ast.Name


class _Binding:
    """What a name refers to in a scope."""

    def __init__(self, kind: int, node: Place, full_name: str = "") -> None:
        self.kind = kind
        self.node = node
        self.full_name = full_name
        self.used = False
        self.is_overload = False
        self.hidden_by: list[Place] = []
        """Where an inner scope binds the name of an import again."""

    @property
    def is_definition(self) -> bool:
        """Whether it is a function, a class or an import."""
        return self.kind in (DEFINED, IMPORTED, SUBMODULE)

    def redefines(self, other: _Binding) -> bool:
        """Tell whether this binding redefines another, unused one."""
        if self.kind == ANNOTATED:
            return False
        if self.kind == SUBMODULE and other.kind in (IMPORTED, SUBMODULE):
            return self.full_name == other.full_name
        if self.kind == IMPORTED and other.kind == SUBMODULE:
            return self.full_name == other.full_name
        if self.kind == DEFINED and other.kind == ASSIGNED:
            return linters.of_target().since("pyflakes", 3)
        return other.is_definition


class _Scope:
    def __init__(self, *, is_class: bool = False, is_comprehension: bool = False) -> None:
        self.names: dict[str, _Binding] = {}
        self.is_class = is_class
        self.is_comprehension = is_comprehension


Redefinition = tuple[Place, str, int]


class _Walk:
    """One walk over a module."""

    def __init__(self, index: ScopeIndex) -> None:
        self.index = index
        self.tree = index.tree
        self.scopes = [_Scope()]
        self.ended = list(self.scopes)
        """The scopes of the module and of functions."""
        self.forks: dict[ast.AST | None, list[frozenset[ast.AST]]] = {}
        """The branches of statements that were asked about."""
        self.deferred: list[tuple[Callable[[], None], list[_Scope]]] = []
        self.redefinitions: list[Redefinition] = []
        self.hidden: list[tuple[str, _Binding]] = []
        self.defers_annotations = any(
            isinstance(node, ast.ImportFrom)
            and node.module == "__future__"
            and any(alias.name == "annotations" for alias in node.names)
            for node in self.tree.body
        )

    def run(self) -> list[Redefinition]:
        """Walk, and return the findings: node, name, line of what is replaced."""
        self.statements(self.tree.body)
        at = 0
        while at < len(self.deferred):
            action, self.scopes = self.deferred[at]
            action()
            at += 1
        exported = _exported(self.tree)
        for name, binding in self.hidden:
            if not binding.used and name not in exported:
                line = binding.node.lineno
                self.redefinitions.extend((place, name, line) for place in binding.hidden_by)
        return self.redefinitions

    def unused_imports(self) -> Iterator[tuple[str, Place]]:
        """Yield the imports that nothing used, after ``run``."""
        exported = _exported(self.tree)
        for scope in self.ended:
            for name, binding in scope.names.items():
                is_import = binding.kind in (IMPORTED, SUBMODULE)
                if is_import and not binding.used and name not in exported:
                    yield name, binding.node

    def defer(self, action: Callable[[], None]) -> None:
        self.deferred.append((action, list(self.scopes)))

    # -- statements

    def statements(self, body: Sequence[ast.stmt]) -> None:
        for node in body:
            self.visit(node)

    def visit(self, node: ast.AST) -> None:
        """Walk a node: uses first, then what it binds, in the order pyflakes takes."""
        method = getattr(self, f"on_{type(node).__name__}", None)
        if method is not None:
            method(node)
        elif isinstance(node, _Comprehension):
            self.comprehension(node)
        else:
            for child in children(node):
                self.visit(child)

    def on_FunctionDef(self, node: ast.FunctionDef) -> None:  # noqa: N802  as ast names it
        for decorator in node.decorator_list:
            self.visit(decorator)
        self.signature(node.args)
        if node.returns:
            self.annotation(node.returns)
        binding = _Binding(DEFINED, node)
        binding.is_overload = any(_last_name(item) == "overload" for item in node.decorator_list)
        self.bind(node.name, binding)
        self.defer(lambda: self.function_body(node))

    on_AsyncFunctionDef = on_FunctionDef  # noqa: N815  as ast names it

    def function_body(self, node: ast.FunctionDef) -> None:
        self.scopes = [*self.scopes, _Scope()]
        self.ended.append(self.scopes[-1])
        self.arguments(node.args)
        self.statements(node.body)

    def on_Lambda(self, node: ast.Lambda) -> None:  # noqa: N802  as ast names it
        self.signature(node.args)

        def body() -> None:
            self.scopes = [*self.scopes, _Scope()]
            self.arguments(node.args)
            self.visit(node.body)

        self.defer(body)

    def signature(self, arguments: ast.arguments) -> None:
        for default in [*arguments.defaults, *arguments.kw_defaults]:
            if default:
                self.visit(default)
        for argument in _all_arguments(arguments):
            if argument.annotation:
                self.annotation(argument.annotation)

    def arguments(self, arguments: ast.arguments) -> None:
        for argument in _all_arguments(arguments):
            self.bind(argument.arg, _Binding(BOUND, argument))

    def on_ClassDef(self, node: ast.ClassDef) -> None:  # noqa: N802  as ast names it
        for part in (*node.decorator_list, *node.bases, *node.keywords):
            self.visit(part)
        self.scopes.append(_Scope(is_class=True))
        self.statements(node.body)
        self.scopes.pop()
        self.bind(node.name, _Binding(DEFINED, node))

    def on_Import(self, node: ast.Import) -> None:  # noqa: N802  as ast names it
        for alias in node.names:
            if "." in alias.name and not alias.asname:
                name = alias.name.partition(".")[0]
                self.bind(name, _Binding(SUBMODULE, node, alias.name))
            else:
                self.bind(alias.asname or alias.name, _Binding(IMPORTED, node, alias.name))

    def on_ImportFrom(self, node: ast.ImportFrom) -> None:  # noqa: N802  as ast names it
        module = "." * node.level + (node.module or "")
        if module == "__future__":
            return
        for alias in node.names:
            full_name = f"{module}.{alias.name}"
            if alias.name == "*":
                self.bind(full_name, _Binding(IMPORTED, node, module))
            else:
                self.bind(alias.asname or alias.name, _Binding(IMPORTED, node, full_name))

    def on_Global(self, node: ast.Global | ast.Nonlocal) -> None:  # noqa: N802  as ast names it
        if len(self.scopes) > 1:
            for name in node.names:
                binding = _Binding(ASSIGNED, node)
                binding.used = True
                self.scopes[0].names.setdefault(name, binding)
                for scope in self.scopes[1:]:
                    scope.names[name] = binding

    on_Nonlocal = on_Global  # noqa: N815  as ast names it

    def on_AugAssign(self, node: ast.AugAssign) -> None:  # noqa: N802  as ast names it
        if isinstance(node.target, ast.Name):
            self.use(node.target.id)
        self.visit(node.value)
        self.visit(node.target)

    def on_AnnAssign(self, node: ast.AnnAssign) -> None:  # noqa: N802  as ast names it
        self.annotation(node.annotation)
        if node.value:
            self.visit(node.value)
        if isinstance(node.target, ast.Name):
            kind = ASSIGNED if node.value else ANNOTATED
            self.bind(node.target.id, _Binding(kind, node))
        else:
            self.visit(node.target)

    def on_Assign(self, node: ast.Assign) -> None:  # noqa: N802  as ast names it
        self.visit(node.value)
        for target in node.targets:
            self.visit(target)

    def on_NamedExpr(self, node: ast.NamedExpr) -> None:  # noqa: N802  as ast names it
        self.visit(node.value)
        self.visit(node.target)

    def on_For(self, node: ast.For | ast.AsyncFor) -> None:  # noqa: N802  as ast names it
        self.visit(node.iter)
        self.visit(node.target)
        self.statements(node.body)
        self.statements(node.orelse)

    on_AsyncFor = on_For  # noqa: N815  as ast names it

    def on_ExceptHandler(self, node: ast.ExceptHandler) -> None:  # noqa: N802  as ast names it
        if node.type:
            self.visit(node.type)
        if not node.name:
            self.statements(node.body)
            return
        names = self.scopes[-1].names
        if node.name in names:
            self.bind(node.name, _Binding(ASSIGNED, node))
        before = names.pop(node.name, None)
        self.bind(node.name, _Binding(ASSIGNED, node))
        self.statements(node.body)
        names.pop(node.name, None)
        if before is not None:
            names[node.name] = before

    def comprehension(
        self, node: ast.ListComp | ast.SetComp | ast.DictComp | ast.GeneratorExp
    ) -> None:
        self.scopes.append(_Scope(is_comprehension=True))
        for generator in node.generators:
            self.visit(generator.iter)
            self.visit(generator.target)
            for condition in generator.ifs:
                self.visit(condition)
        if isinstance(node, ast.DictComp):
            self.visit(node.key)
            self.visit(node.value)
        else:
            self.visit(node.elt)
        self.scopes.pop()

    # -- names

    def on_Name(self, node: ast.Name) -> None:  # noqa: N802  as ast names it
        if isinstance(node.ctx, ast.Load):
            self.use(node.id)
        elif isinstance(node.ctx, ast.Store):
            kind, for_loop = self.kind_of(node)
            self.bind(node.id, _Binding(kind, node), for_loop=for_loop)
        else:
            self.delete(node)

    def delete(self, node: ast.Name) -> None:
        conditional = (ast.If, ast.While, ast.IfExp)
        if any(isinstance(parent, conditional) for parent in self.index.parents(node)):
            return
        self.scopes[-1].names.pop(node.id, None)

    def annotation(self, node: ast.expr) -> None:
        if isinstance(node, ast.Constant) and isinstance(node.value, str):
            self.defer(lambda: self.quoted(str(node.value)))
        elif self.defers_annotations:
            self.defer(lambda: self.annotation_now(node))
        else:
            self.annotation_now(node)

    def annotation_now(self, node: ast.expr) -> None:
        for part in ast.walk(node):
            if isinstance(part, ast.Constant) and isinstance(part.value, str):
                self.quoted(part.value)
        self.visit(node)

    def quoted(self, text: str) -> None:
        try:
            self.visit(ast.parse(text.strip(), mode="eval").body)
        except (SyntaxError, ValueError):
            return

    def use(self, name: str) -> None:
        """Mark what a name refers to as used; class scopes are not seen from inside functions."""
        inner_comprehensions = True
        for at, scope in enumerate(reversed(self.scopes)):
            if scope.is_class and at > 0 and not inner_comprehensions:
                continue
            inner_comprehensions = inner_comprehensions and scope.is_comprehension
            binding = scope.names.get(name)
            if binding is not None:
                binding.used = True
                if binding.kind == IMPORTED and binding.full_name in scope.names:
                    # `import x` next to `import x as y`: the use of `y` is one of `x`.
                    scope.names[binding.full_name].used = True
                if binding.kind != ANNOTATED:
                    return
        if name not in _MAGIC and not hasattr(builtins, name):
            self.use_star_imports()

    def use_star_imports(self) -> None:
        """Mark all star imports as used: a name that nothing else defines may be theirs."""
        for scope in self.scopes:
            for name, binding in scope.names.items():
                if name.endswith(".*"):
                    binding.used = True

    def bind(self, name: str, value: _Binding, *, for_loop: bool = False) -> None:
        """Bind a name in the innermost scope and report what is lost."""
        scope = self.scopes[-1]
        existing = scope.names.get(name)
        if (
            existing is not None
            and not existing.used
            and not (for_loop and existing.kind in (IMPORTED, SUBMODULE))
            and value.redefines(existing)
            and (name != "_" or existing.kind in (IMPORTED, SUBMODULE))
            and not existing.is_overload
            and not self.in_other_fork(value.node, existing.node)
        ):
            self.redefinitions.append((value.node, name, existing.node.lineno))
        if existing is None:
            self.hide(name, value, for_loop=for_loop)
        else:
            value.used = existing.used
            if value.kind == ANNOTATED:
                return
        scope.names[name] = value

    def hide(self, name: str, value: _Binding, *, for_loop: bool) -> None:
        """Remember that an inner scope binds the name of an import of an outer one."""
        existing = next((s.names[name] for s in reversed(self.scopes) if name in s.names), None)
        if (
            existing is not None
            and existing.kind in (IMPORTED, SUBMODULE)
            and not for_loop
            and value.redefines(existing)
            and not self.in_other_fork(value.node, existing.node)
        ):
            if not existing.hidden_by:
                self.hidden.append((name, existing))
            existing.hidden_by.append(value.node)

    def kind_of(self, node: ast.Name) -> tuple[int, bool]:
        """Return how a stored name is bound, and whether by a ``for`` statement."""
        direct = parent = self.index.parent(node)
        while isinstance(parent, (ast.Tuple, ast.List, ast.Starred)):
            parent = self.index.parent(parent)
        for_loop = isinstance(parent, (ast.For, ast.AsyncFor))
        if for_loop or isinstance(parent, ast.comprehension):
            return BOUND, for_loop
        if parent is not direct and not _unpacks_literal(parent):
            return BOUND, False
        return ASSIGNED, False

    def in_other_fork(self, node: ast.AST, other: ast.AST) -> bool:
        """Tell whether two nodes are on different branches of their innermost common statement."""
        path, other_path = self.path(node), self.path(other)
        common = None
        for step, other_step in zip(path, other_path, strict=False):
            if step is not other_step:
                break
            common = step
        if common not in self.forks:
            self.forks[common] = [frozenset(part) for part in _branches(common)]
        return any(
            part.isdisjoint(path) != part.isdisjoint(other_path) for part in self.forks[common]
        )

    def path(self, node: ast.AST) -> list[ast.AST]:
        return [node, *self.index.parents(node)][::-1]


def _unpacks_literal(node: ast.AST | None) -> bool:
    """Tell whether a tuple is assigned to a tuple, element by element."""
    return isinstance(node, ast.Assign) and all(
        isinstance(target, (ast.Tuple, ast.List, ast.Set)) for target in (*node.targets, node.value)
    )


def _exported(tree: ast.Module) -> set[str]:
    """Return the strings in the statements that set ``__all__``."""
    return {
        part.value
        for node in tree.body
        if isinstance(node, (ast.Assign, ast.AugAssign, ast.AnnAssign))
        for target in (node.targets if isinstance(node, ast.Assign) else [node.target])
        if isinstance(target, ast.Name) and target.id == "__all__"
        for part in ast.walk(node)
        if isinstance(part, ast.Constant) and isinstance(part.value, str)
    }


def _branches(node: ast.AST | None) -> list[Sequence[ast.AST]]:
    if isinstance(node, ast.If):
        return [node.body]
    if isinstance(node, ast.Try):
        return [[*node.body, *node.orelse], *([handler] for handler in node.handlers)]
    if isinstance(node, ast.Match) and linters.of_target().since("pyflakes", 3):
        return [case.body for case in node.cases]
    return []


def _all_arguments(arguments: ast.arguments) -> list[ast.arg]:
    plain = [*arguments.posonlyargs, *arguments.args, *arguments.kwonlyargs]
    return plain + [item for item in (arguments.vararg, arguments.kwarg) if item]


def _last_name(node: ast.expr) -> str:
    if isinstance(node, ast.Attribute):
        return node.attr
    return node.id if isinstance(node, ast.Name) else ""


def _repeated_aliases(text: PythonText) -> set[tuple[str, ast.AST]]:
    """Return the imports of the form ``import x as x``, which ruff takes for exports."""
    return {
        (alias.name, node)
        for node in text.imports
        for alias in node.names
        if alias.asname == alias.name
    }


def _is_worth_a_walk(text: PythonText) -> bool:
    """Tell whether some name is bound twice in the file, once at least by a definition."""
    defined = Counter(function.name for function in text.functions)
    defined.update(class_.name for class_ in text.nodes(ast.ClassDef))
    for imported in text.imports:
        defined.update(item.asname or item.name.partition(".")[0] for item in imported.names)
    others = {node.id for node in text.nodes(ast.Name) if isinstance(node.ctx, ast.Store)}
    others |= {node.arg for node in text.nodes(ast.arg)}
    others |= {node.name for node in text.nodes(ast.ExceptHandler) if node.name}
    return any(count > 1 or name in others for name, count in defined.items())
