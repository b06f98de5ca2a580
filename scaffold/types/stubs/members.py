"""The members of classes, functions and modules in the stubs, for hints in messages."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator, Mapping, Sequence
from functools import lru_cache

from scaffold import distributions
from scaffold.distributions import Distribution
from scaffold.model.package import Package
from scaffold.types.stubs import libraries as stubs
from scaffold.types.stubs.marks import MARK

_KINDS = frozenset({"msg", "srv", "action"})
_MAX_DEPTH = 12
"""The maximum depth of base classes that is followed."""


def members(package: Package, marked: str) -> frozenset[str]:
    """Return the names of the public members of a class, those of its bases included.

    Args:
        package: The package that uses it; its workspace may define interfaces.
        marked: The marked name of the class.
    """
    return frozenset(name for name in _all_names(package, marked) if not name.startswith("_"))


def own_members(package: Package, name: str, *, is_inside: bool = False) -> frozenset[str]:
    """Return the names that a class of a package defines or that its methods assign.

    Args:
        package: The package.
        name: The class.
        is_inside: Whether private names are included.
    """
    result: set[str] = set()
    for module in package.modules(mentioning=[f"class {name}"]):
        for node in module.walk(ast.ClassDef):
            if node.name == name:
                result.update(_names(node.body))
                result.update(
                    inner.attr
                    for inner in ast.walk(node)
                    if isinstance(inner, ast.Attribute) and isinstance(inner.ctx, ast.Store)
                    if isinstance(inner.value, ast.Name) and inner.value.id == "self"
                )
    return frozenset(name for name in result if is_inside or not name.startswith("_"))


def has_call(package: Package, marked: str) -> bool:
    """Return whether instances of a class are callable."""
    return "__call__" in _all_names(package, marked)


def is_kind_of(package: Package, marked: str, wanted: str) -> bool:
    """Return whether a class is the same as another one or derives from it."""
    return marked == wanted or any(
        wanted in _resolved(tree, module, base)
        for node, module, tree in _with_bases(package, marked)
        for base in node.bases
    )


def _all_names(package: Package, marked: str) -> set[str]:
    return {name for node, _, _ in _with_bases(package, marked) for name in _names(node.body)}


def _with_bases(package: Package, marked: str) -> Iterator[tuple[ast.ClassDef, str, ast.Module]]:
    """Yield a class and its bases, each with its module and the tree of the module."""
    pending = [marked]
    for _ in range(_MAX_DEPTH):
        class_ = _class(package, pending.pop()) if pending else None
        if class_ is not None:
            node, module, tree = class_
            yield class_
            for base in node.bases:
                pending += _resolved(tree, module, base)


def module_names(package: Package, module: str) -> frozenset[str]:
    """Return the public names of a module."""
    tree = _tree(package, module)
    names = {*_names(tree.body)} if tree is not None else set()
    start = f"{module.replace('.', '/')}/"
    below = [path[len(start) :] for path in _stubs_of(package, module) if path.startswith(start)]
    names.update(path.removesuffix(".pyi").partition("/")[0] for path in below)
    return frozenset(name for name in names if not name.startswith("_"))


def modules_with(package: Package, name: str, instead_of: str) -> Sequence[str]:
    """Return the modules that have a name which another module lacks, if they are plausible.

    These are the modules below it; ``std_srvs.srv`` for ``std_msgs.srv``; and
    ``launch_ros.actions`` for ``launch.actions``.
    """
    root, _, last = instead_of.partition(".")
    alike = re.compile(rf"\w+\.{last}" if last in _KINDS else rf"{root.split('_')[0]}\w*\.{last}")
    stubs_at_hand = {**_bundled(distributions.target()), **_stubs_of(package, instead_of)}
    named = re.compile(rf"\b{name}\b")
    likely = {
        module
        for path, text in stubs_at_hand.items()
        if (module := _module(path)).startswith(f"{instead_of}.") or alike.fullmatch(module)
        if "._" not in module and named.search(text)
    }
    return sorted(item for item in likely if name in module_names(package, item))


def _module(path: str) -> str:
    return path.removesuffix(".pyi").removesuffix("/__init__").replace("/", ".")


def parameters(package: Package, callee: str) -> Sequence[str]:
    """Return the names of the positional parameters of a function, without ``self``.

    Args:
        package: The package that calls it.
        callee: Its name in a message: ``function`` or ``Class.method``.
    """
    function = _function(package, callee)
    if function is None:
        return ()
    return _positional(function, callee)


def overload_problem(package: Package, callee: str, call: ast.Call) -> str:
    """Return why no overload of a function can take the arguments of a call, whatever their types.

    Returns:
        The problem with the closest overload; empty if one takes them.
    """
    if any(isinstance(item, ast.Starred) for item in call.args):
        return ""
    if any(keyword.arg is None for keyword in call.keywords):
        return ""
    problems = [
        problem
        for function in _functions(package, callee)
        if (problem := _call_problem(function, _positional(function, callee), call)) is not None
    ]
    return min(problems, key=len) if problems and all(problems) else ""


def _call_problem(
    function: ast.FunctionDef | ast.AsyncFunctionDef, names: Sequence[str], call: ast.Call
) -> str | None:
    """Return the missing or surplus arguments of a call; ``None`` if a signature takes anything."""
    arguments = function.args
    if arguments.vararg is not None or arguments.kwarg is not None:
        return None
    given = {*names[: len(call.args)], *(keyword.arg or "" for keyword in call.keywords)}
    by_keyword = [item.arg for item in arguments.kwonlyargs]
    for name in sorted(given):
        if name not in names and name not in by_keyword:
            return f"has no argument {name!r}"
    if len(call.args) > len(names):
        return f"takes {len(names)} positional arguments at most, not {len(call.args)}"
    required = names[: len(names) - len(arguments.defaults)]
    missing = [repr(name) for name in required if name not in given]
    return f"lacks {' and '.join(missing)}" if missing else ""


def _positional(function: ast.FunctionDef | ast.AsyncFunctionDef, callee: str) -> Sequence[str]:
    names = [item.arg for item in (*function.args.posonlyargs, *function.args.args)]
    decorators = function.decorator_list
    is_static = any(isinstance(item, ast.Name) and item.id == "staticmethod" for item in decorators)
    return names[1:] if "." in callee and not is_static else names


def keywords(package: Package, callee: str) -> Sequence[str]:
    """Return the names of the keyword-only parameters of a function."""
    function = _function(package, callee)
    return [item.arg for item in function.args.kwonlyargs] if function is not None else ()


def _function(package: Package, callee: str) -> ast.FunctionDef | ast.AsyncFunctionDef | None:
    """Return a function or method by its name in a message; ``None`` if it has overloads."""
    named = _functions(package, callee)
    return named[0] if len(named) == 1 else None


def _functions(package: Package, callee: str) -> Sequence[ast.FunctionDef | ast.AsyncFunctionDef]:
    owner, _, method = callee.rpartition(".")
    class_ = _class(package, owner) if owner else None
    if owner and class_ is None:
        return ()
    if class_ is not None:
        body: Sequence[ast.stmt] = class_[0].body
    else:
        method, *where = callee.split(MARK)
        tree = _tree(package, ".".join(where))
        body = tree.body if tree is not None else ()
    return [
        node
        for node in body
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef) and node.name == method
    ]


def _class(package: Package, marked: str) -> tuple[ast.ClassDef, str, ast.Module] | None:
    """Return the class of a marked name, its module, and the tree of the module."""
    name, *where = marked.split(MARK)
    for depth in range(len(where), 0, -1):
        module = ".".join(where[:depth])
        tree = _tree(package, module)
        body: Sequence[ast.stmt] = tree.body if tree is not None else ()
        for inside in [*where[depth:], name]:
            node = next((n for n in body if isinstance(n, ast.ClassDef) and n.name == inside), None)
            if node is None:
                break
            body = node.body
        else:
            if tree is not None and node is not None:
                return node, module, tree
    return None


def _resolved(tree: ast.Module, module: str, base: ast.expr) -> list[str]:
    """Return the marked name of a base class if the imports of its module determine it."""
    if isinstance(base, ast.Subscript):
        base = base.value
    if not isinstance(base, ast.Name):
        return []
    for node in tree.body:
        if isinstance(node, ast.ClassDef) and node.name == base.id:
            return [MARK.join([base.id, *module.split(".")])]
        if isinstance(node, ast.ImportFrom) and node.module and not node.level:
            for alias in node.names:
                if (alias.asname or alias.name) == base.id:
                    return [MARK.join([alias.name, *node.module.split(".")])]
    return []


def _names(body: Sequence[ast.stmt]) -> list[str]:
    result: list[str] = []
    for node in body:
        match node:
            case ast.FunctionDef(name=name) | ast.AsyncFunctionDef(name=name):
                result.append(name)
            case ast.ClassDef(name=name) | ast.AnnAssign(target=ast.Name(id=name)):
                result.append(name)
            case ast.Assign(targets=targets):
                result += [target.id for target in targets if isinstance(target, ast.Name)]
            case ast.ImportFrom(names=names):
                result += [alias.asname for alias in names if alias.asname]
            case _:
                pass
    return result


def _tree(package: Package, module: str) -> ast.Module | None:
    return _parsed(_stubs_of(package, module), module)


def _stubs_of(package: Package, module: str) -> Mapping[str, str]:
    """Return the stubs that contain a module: those of a workspace package, or the bundled ones."""
    root = module.partition(".")[0]
    other = package if package.name == root else package.workspace.get(root)
    if other is not None:
        return other.remember("stubs", lambda: stubs.interface_stub_files(other))
    return _bundled_of(distributions.target(), root)


@lru_cache(maxsize=16)
def _bundled_of(distribution: Distribution, root: str) -> Mapping[str, str]:
    if root in stubs.partial_libraries():
        return stubs.partial_stubs(root)
    return stubs.stubs_of(distribution, root)


@lru_cache(maxsize=1)
def _bundled(distribution: Distribution) -> Mapping[str, str]:
    return stubs.stub_files(distribution)


def _parsed(files: Mapping[str, str], module: str) -> ast.Module | None:
    path = module.replace(".", "/")
    text = files.get(f"{path}.pyi", files.get(f"{path}/__init__.pyi"))
    try:
        return None if text is None else ast.parse(text)
    except SyntaxError:
        return None
