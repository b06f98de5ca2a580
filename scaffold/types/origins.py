"""Where a value comes from, to decide whether its inferred type is certain."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Sequence
from collections.abc import Set as AbstractSet
from typing import TypeGuard

from scaffold.model.package import Package
from scaffold.model.python.conditions.handlers import last_name
from scaffold.model.python.evaluation.given_arguments import (
    arguments_for,
    given_argument,
    parameter_of,
)
from scaffold.model.python.evaluation.values import is_none_literal
from scaffold.model.python.module import PythonModule
from scaffold.types.rewriting.passed import calls_from_modules

_MAX_DEPTH = 20
"""The maximum number of names, attributes, elements and calls to trace a value through."""
_MAX_FUNCTIONS = 4
"""The maximum number of functions that pass it on."""
_HANDING_ON = frozenset({"enumerate", "iter", "list", "next", "reversed", "sorted", "tuple", "zip"})
_PUTTING = frozenset({"append", "appendleft", "insert", "setdefault"})
_OF_TEXT_OR_BYTES = frozenset({"fnmatch", "glob", "os", "re", "shutil", "tempfile", "urllib"})
"""Modules whose functions return bytes for bytes, and some of them for ``None``."""


def is_of_several(
    module: PythonModule, node: ast.AST, reported: AbstractSet[str] = frozenset()
) -> bool:
    """Return whether a value may be one of several that the type checker reports one by one.

    This applies to entries of a dictionary, ``self.clients['reset']``, and to values from an
    attribute with values of several origins.

    Args:
        module: The file.
        node: The value.
        reported: The names of classes in the report, which tell the entries of a table apart.
    """
    for origin in _origins(module, node):
        match origin:
            case ast.Subscript(slice=ast.Constant(value=str())) as entry:
                if not reported.isdisjoint(_classes_in(_entry(module, entry))):
                    return False
                if len(_contents_of(module, entry.value)) != 1:
                    return True
            case ast.Attribute(value=ast.Name(id="self"), attr=name):
                sources = _sources_of(module, name, origin)
                if len(sources) > 1 or len(_contents_of(module, origin)) > 1:
                    return True
            case ast.Name():
                if len(_contents_of(module, origin)) > 1:
                    return True
    return False


def has_default(module: PythonModule, node: ast.AST) -> bool:
    """Return whether a value is of an attribute that a class has, and its objects replace.

    The type checker only knows the value of the class if it does not know a base class.
    """
    names = {origin.attr for origin in _origins(module, node) if isinstance(origin, ast.Attribute)}
    stored = {
        name
        for name in names
        if any(
            isinstance(use.ctx, ast.Store) and isinstance(use.value, ast.Name)
            for use in module.index.attributes(name)
        )
    }
    return any(
        not stored.isdisjoint(module.index.bindings(class_))
        for class_ in (module.walk(ast.ClassDef) if stored else ())
    )


def is_placeholder(module: PythonModule, node: ast.AST) -> bool:
    """Return whether a reported value only reserves space in a container, such as ``[0] * 8``.

    The type checker does not notice that a statement replaces the elements by other objects,
    or adds others to the dictionaries in a container.
    """
    traced = [*_origins(module, node)]
    containers = (origin for origin in traced if _is_container(origin))
    return _is_set_under_key(module, traced) or any(
        any(isinstance(value, ast.Constant) for value in _initial_values(module, container))
        and any(
            not isinstance(value, ast.Constant)
            for mention in _mentions(module, container)
            for value in _set_by_index(module, mention)
        )
        for container in containers
    )


def _is_set_under_key(module: PythonModule, traced: Sequence[ast.AST]) -> bool:
    """Return whether a statement sets an entry with a key that is read to an object."""
    keys = {key for origin in traced if (key := _key(origin)) is not None}
    return any(
        _key(target) in keys and not isinstance(statement.value, ast.Constant)
        for statement in (module.walk(ast.Assign) if keys else ())
        for target in statement.targets
        if isinstance(target, ast.Subscript) and isinstance(target.value, ast.Subscript)
    )


def _key(node: ast.AST) -> str | None:
    """Return the string in brackets."""
    match node:
        case ast.Subscript(slice=ast.Constant(value=str(key))):
            return key
    return None


def may_be_text(module: PythonModule, node: ast.AST) -> bool:
    """Return whether a value that is reported as bytes is a str if the argument is not ``None``.

    The type checker takes all overloads that fit some types of an argument.
    """
    return any(
        isinstance(origin, ast.Call)
        and (module.qualified_name(origin.func) or "").partition(".")[0] in _OF_TEXT_OR_BYTES
        and not any(
            isinstance(part, ast.Constant) and isinstance(part.value, bytes)
            for part in ast.walk(origin)
        )
        for origin in _origins(module, node)
    )


def is_attribute(module: PythonModule, node: ast.AST) -> bool:
    """Return whether a value is read from an object: libraries declare all of its types."""
    values = [node, *(arguments_for(module, node) if isinstance(node, ast.Name) else ())]
    return any(
        isinstance(value, ast.Attribute) and module.text(value.value) != "self" for value in values
    )


def is_unpacked_of_several(module: PythonModule, value: ast.expr) -> bool:
    """Return whether an unpacked value may be another one than the reported one."""
    if isinstance(value, ast.Subscript) and is_of_several(module, value):
        return True
    return is_attribute(module, value)


def is_assigned_of_several(module: PythonModule, statement: ast.Assign, value: ast.AST) -> bool:
    """Return whether the value or a target of an assignment may be one of several objects.

    The type checker reports all types of attributes of ``self`` and of results of its methods.
    """
    if any(is_of_several(module, target) for target in statement.targets):
        return True
    match value.func if isinstance(value, ast.Call) else value:
        case ast.Attribute(value=ast.Name(id="self")):
            return False
    return is_of_several(module, value)


def _origins(module: PythonModule, node: ast.AST, depth: int = 0) -> Iterator[ast.AST]:
    """Yield an expression and its origins: ``a.b``, then ``a``, also in other functions."""
    for _ in range(_MAX_DEPTH if depth < _MAX_FUNCTIONS else 0):
        yield node
        match node:
            case ast.Attribute(value=value) | ast.Subscript(value=value):
                node = value
            case ast.Call(func=ast.Name(id=name), args=[first, *_]) if name in _HANDING_ON:
                node = first
            case ast.Call(func=func):
                node = func
            case ast.Name():
                looped = _looped_over(module, node)
                if looped is None:
                    for value in (*arguments_for(module, node), *_assigned(module, node)):
                        yield from _origins(module, value, depth + 1)
                    return
                node = looped
            case _:
                return


def _assigned(module: PythonModule, name: ast.Name) -> Iterator[ast.expr]:
    """Yield the entries of containers that are assigned to a variable."""
    for binding in module.index.bindings_of(name):
        statement = module.parent(binding.node)
        if not isinstance(statement, ast.Assign) or binding.node not in statement.targets:
            continue
        if isinstance(statement.value, ast.Subscript | ast.Call):
            yield statement.value


def _is_container(node: ast.AST) -> TypeGuard[ast.Name | ast.Attribute]:
    """Return whether a node is a variable or an attribute, which may hold a container."""
    return isinstance(node, ast.Name | ast.Attribute)


def _contents_of(module: PythonModule, container: ast.expr) -> set[str]:
    """Return the sources of the values added to a variable or an attribute of ``self``."""
    if not _is_container(container):
        return set()
    mentions = _mentions(module, container)
    return {source for mention in mentions for source in _put_into(module, mention)}


def _mentions(
    module: PythonModule, container: ast.Name | ast.Attribute
) -> Iterator[ast.Name | ast.Attribute]:
    """Yield the uses of a variable or an attribute in the file, by its name."""
    if isinstance(container, ast.Name):
        yield from module.index.names(container.id)
        return
    text = module.text(container)
    for attribute in module.index.attributes(container.attr):
        if module.text(attribute) == text:
            yield attribute


def _put_into(module: PythonModule, container: ast.expr) -> set[str]:
    """Return the sources of the values that a statement adds to a container."""
    parent = module.parent(container)
    above = module.parent(parent) if parent is not None else None
    values = _set_by_index(module, container)
    match parent, above:
        case ast.Attribute(attr=name), ast.Call(args=arguments) if name in _PUTTING:
            values = arguments[-1:]
        case ast.Assign(value=value), _:
            values = _elements(value)
    sources: set[str] = set()
    for value in values:
        if isinstance(value, ast.Subscript):
            sources |= {f"{module.text(value)} in line {value.lineno}", "another container"}
        elif not is_none_literal(value):
            sources.add(_source(module, value))
    return sources


def _set_by_index(module: PythonModule, container: ast.expr) -> Sequence[ast.expr]:
    """Return the value of ``container[...] = value``, if this is the container."""
    match parent := module.parent(container):
        case ast.Subscript(value=of) if of is container:
            above = module.parent(parent)
            if isinstance(above, ast.Assign) and parent in above.targets:
                return [above.value]
    return ()


def _initial_values(
    module: PythonModule, container: ast.Name | ast.Attribute
) -> Iterator[ast.expr]:
    """Yield the elements of the displays that are assigned to a variable or an attribute."""
    for mention in _mentions(module, container):
        match module.parent(mention):
            case ast.Assign(value=value) | ast.AnnAssign(value=ast.expr() as value):
                if mention is not value:
                    yield from _elements(value)


def _elements(value: ast.expr) -> Sequence[ast.expr]:
    """Return the elements of a list or the values of a dictionary, as far as they are written."""
    match value:
        case ast.Dict(values=elements) | ast.List(elts=elements):
            return elements
        case ast.BinOp(left=ast.List(elts=elements), op=ast.Mult()):
            return elements
        case ast.BinOp(op=ast.Mult(), right=ast.List(elts=elements)):
            return elements
        case ast.ListComp(elt=element) | ast.DictComp(value=element):
            return [element]
    return ()


def _entry(module: PythonModule, entry: ast.Subscript) -> ast.expr | None:
    """Return the value of an entry of a dictionary literal that is set once and never changed."""
    text = module.text(entry.value)
    set_to = [
        statement.value
        for statement in module.walk(ast.Assign)
        if any(module.text(target).partition("[")[0] == text for target in statement.targets)
    ]
    if len(set_to) != 1 or not isinstance(set_to[0], ast.Dict):
        return None
    wanted = ast.dump(entry.slice)
    pairs = zip(set_to[0].keys, set_to[0].values, strict=True)
    found = [value for key, value in pairs if key is not None and ast.dump(key) == wanted]
    return found[0] if len(found) == 1 and not module.mentions(f"{text}.update(") else None


def _classes_in(value: ast.expr | None) -> set[str]:
    """Return the names of the classes among the arguments of a call."""
    given = value.args if isinstance(value, ast.Call) else []
    return {ast.unparse(item).rpartition(".")[2] for item in given if _is_class(item)}


def _source(module: PythonModule, value: ast.expr) -> str:
    """Return the source of a value: a call with its class arguments, or an expression."""
    if isinstance(value, ast.Call):
        classes = [module.text(item) for item in value.args if _is_class(item)]
        classes += [module.text(item.value) for item in value.keywords if _is_class(item.value)]
        return f"{module.text(value.func)}({', '.join(classes)})"
    if isinstance(value, ast.Constant):
        return type(value.value).__name__
    if isinstance(value, ast.Attribute) and value.attr.isupper() and _is_class(value.value):
        return f"a constant of {module.text(value.value)}"
    function = module.enclosing_function(value) if isinstance(value, ast.Name) else None
    return f"{module.text(value)} of {function.name if function else ''}"


def _is_nothing(value: ast.expr) -> bool:
    """Return whether the type of a value is irrelevant: ``None``, or an empty container."""
    match value:
        case ast.Constant(value=None) | ast.List(elts=[]) | ast.Dict(keys=[]):
            return True
        case ast.Call(func=ast.Name(id="dict" | "list" | "set"), args=[], keywords=[]):
            return True
    return False


def _is_class(value: ast.expr) -> bool:
    return last_name(value)[:1].isupper()


def called_as(module: PythonModule, name: ast.Name) -> str:
    """Return the name of the function of a parameter: ``to_pose``, ``Arm.move``."""
    function = parameter_of(module, name)[1]
    class_ = module.parent(function) if function is not None else None
    if function is None or not isinstance(class_, ast.ClassDef):
        return function.name if function is not None else ""
    return class_.name if function.name == "__init__" else f"{class_.name}.{function.name}"


def given_by_modules(
    package: Package, path: str, name: ast.Name
) -> Iterator[tuple[PythonModule, ast.expr | None, str]]:
    """Yield what other modules pass for a parameter: the module, the argument, and its place.

    The argument is ``None`` if the function is a callback there.
    """
    parameter, function = parameter_of(package.module(path), name)
    called = called_as(package.module(path), name)
    if parameter is None or function is None or not called:
        return
    for place in calls_from_modules(package, path, called):
        module = place.package.module(place.path)
        values = (
            given_argument(function, call, parameter, is_method=called != function.name)
            for call in module.walk(ast.Call)
            if call.lineno == place.line and last_name(call.func) == called.rpartition(".")[2]
        )
        yield module, next(values, None), place.seen_from(package)


def is_handed_on(module: PythonModule, value: ast.expr | None) -> bool:
    """Return whether an argument is a parameter of the caller."""
    return isinstance(value, ast.Name) and parameter_of(module, value)[0] is not None


def other_parameters(module: PythonModule, name: ast.Name) -> frozenset[str]:
    """Return the other parameters of the function of a parameter; empty for other names."""
    parameter, function = parameter_of(module, name)
    if parameter is None or function is None or parameter.arg == "self":
        return frozenset()
    given = function.args
    names = {item.arg for item in (*given.posonlyargs, *given.args, *given.kwonlyargs)}
    return frozenset(names - {parameter.arg, "self"})


def _looped_over(module: PythonModule, name: ast.Name) -> ast.expr | None:
    """Return the iterable of the loop that binds a name."""
    for binding in module.index.bindings_of(name):
        target = binding.node
        while isinstance(parent := module.parent(target), ast.Tuple | ast.List):
            target = parent  # for name, value in
        if isinstance(parent, ast.For | ast.AsyncFor | ast.comprehension):
            return parent.iter if parent.target is target else None
    return None


def _sources_of(module: PythonModule, name: str, used: ast.AST) -> set[str]:
    """Return the sources of the values of an attribute of ``self``, in the class that uses it."""
    sources = set()
    statements: list[ast.Assign | ast.AnnAssign] = [*module.walk(ast.Assign)]
    statements += module.walk(ast.AnnAssign)
    for statement in statements:
        targets = statement.targets if isinstance(statement, ast.Assign) else [statement.target]
        value = statement.value
        if value is None or _is_nothing(value):
            continue
        if any(
            isinstance(target, ast.Attribute)
            and target.attr == name
            and not _is_of_other_class(module, target, used)
            for target in targets
        ):
            sources.add(_source(module, value))
    return sources


def _is_of_other_class(module: PythonModule, target: ast.Attribute, used: ast.AST) -> bool:
    """Return whether an attribute is that of ``self`` in a class without relation to another."""
    classes = [module.enclosing_class(node) for node in (target, used)]
    if module.text(target.value) != "self" or None in classes or classes[0] is classes[1]:
        return False
    bases = {last_name(base) for class_ in module.walk(ast.ClassDef) for base in class_.bases}
    defined = {class_.name for class_ in module.walk(ast.ClassDef)}
    return not any(
        class_ is not None
        and (class_.name in bases or not defined.isdisjoint(map(last_name, class_.bases)))
        for class_ in classes
    )
