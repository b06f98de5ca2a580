"""From a template, as Jinja parses it, to Python that needs no Jinja to run.

Only the part of Jinja that the built-in templates are written in; whatever else a template holds
is left to Jinja. `scaffold.generate.programs` says what the Python finds around it. A variable is
an entry of a dictionary, so no name of a template becomes one in Python.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from types import CodeType

from jinja2 import nodes

from scaffold.generate.programs import FILTERS

_COMPARED: Mapping[str, str] = {
    "eq": "==",
    "ne": "!=",
    "gt": ">",
    "gteq": ">=",
    "lt": "<",
    "lteq": "<=",
    "in": "in",
    "notin": "not in",
}
_BINARY: Mapping[type[nodes.Expr], str] = {
    nodes.Add: "+",
    nodes.Sub: "-",
    nodes.Mul: "*",
    nodes.And: "and",
    nodes.Or: "or",
}
_PRIVATE = "_"
"""What a name begins with that templates have no business with."""


class UntranslatableError(Exception):
    """The template holds something that Jinja alone can render."""


def translate(template: nodes.Template, name: str) -> CodeType:
    """Return the code of a template: it defines ``render(v0, env)``, which returns the text.

    Args:
        template: What Jinja made of its text.
        name: For tracebacks.

    Raises:
        UntranslatableError: it is left to Jinja.
    """
    lines = ["def render(v0, env):", *_indented(_Writer().block(template.body, 0)), ""]
    try:
        return compile("\n".join(lines), f"<{name}>", "exec", dont_inherit=True)
    except (SyntaxError, RecursionError, MemoryError) as error:
        raise UntranslatableError(str(error)) from error


def _indented(lines: Iterator[str]) -> Iterator[str]:
    return (f" {line}" for line in lines)


class _Writer:
    """Writes lines of Python; numbers keep the scopes and what else has a name apart."""

    def __init__(self) -> None:
        self._count = 0

    def _new(self) -> int:
        self._count += 1
        return self._count

    def block(self, body: Sequence[nodes.Node], scope: int) -> Iterator[str]:
        """Yield statements that return the text of a body, whose variables are in ``v<scope>``."""
        out = self._new()
        yield f"o{out} = []"
        yield from self._body(body, scope, out)
        yield f"return ''.join(o{out})"

    def _body(self, body: Sequence[nodes.Node], scope: int, out: int) -> Iterator[str]:
        empty = True
        for node in body:
            write = getattr(self, f"_{type(node).__name__.lower()}", None)
            if not isinstance(node, nodes.Stmt) or write is None:
                raise UntranslatableError(type(node).__name__)
            for line in write(node, scope, out):
                empty = False
                yield line
        if empty:
            yield "pass"

    # -- statements

    def _output(self, node: nodes.Output, scope: int, out: int) -> Iterator[str]:
        for part in node.nodes:
            if isinstance(part, nodes.TemplateData):
                yield f"o{out}.append({part.data!r})"
            else:
                yield f"o{out}.append(env.shown({self._value(part, scope)}))"

    def _if(self, node: nodes.If, scope: int, out: int) -> Iterator[str]:
        for word, one in (("if", node), *(("elif", one) for one in node.elif_)):
            yield f"{word} {self._value(one.test, scope)}:"
            yield from _indented(self._body(one.body, scope, out))
        if node.else_:
            yield "else:"
            yield from _indented(self._body(node.else_, scope, out))

    def _for(self, node: nodes.For, scope: int, out: int) -> Iterator[str]:
        if node.recursive:
            raise UntranslatableError("recursive")
        inner = self._new()
        yield f"i{inner} = list({self._value(node.iter, scope)})"
        if node.test is not None:
            yield f"def f{inner}(x{inner}):"
            yield f" v{inner} = v{scope}.copy()"
            yield f" {self._target(node.target, inner)} = x{inner}"
            yield f" return {self._value(node.test, inner)}"
            yield f"i{inner} = list(filter(f{inner}, i{inner}))"
        yield f"for n{inner}, x{inner} in enumerate(i{inner}):"
        yield f" v{inner} = v{scope}.copy()"
        yield f" v{inner}['loop'] = env.loop(n{inner}, len(i{inner}))"
        yield f" {self._target(node.target, inner)} = x{inner}"
        yield from _indented(self._body(node.body, inner, out))
        if node.else_:
            yield f"if not i{inner}:"
            yield f" v{inner} = v{scope}.copy()"
            yield from _indented(self._body(node.else_, inner, out))

    def _macro(self, node: nodes.Macro, scope: int, out: int) -> Iterator[str]:
        del out
        inner = self._new()
        names = [one.name for one in node.args]
        needed = names[: len(names) - len(node.defaults)]
        yield f"def m{inner}(*given, **named):"
        yield f" b{inner} = env.bound({names!r}, {needed!r}, given, named)"
        yield f" v{inner} = v{scope} | b{inner}"
        for name, default in zip(names[len(needed) :], node.defaults, strict=True):
            yield f" if {name!r} not in b{inner}:"
            yield f"  v{inner}[{name!r}] = {self._value(default, inner)}"
        yield from _indented(self.block(node.body, inner))
        yield f"v{scope}[{node.name!r}] = m{inner}"

    def _assign(self, node: nodes.Assign, scope: int, out: int) -> Iterator[str]:
        del out
        yield f"{self._target(node.target, scope)} = {self._value(node.node, scope)}"

    def _target(self, node: nodes.Node, scope: int) -> str:
        if isinstance(node, nodes.Name):
            return f"v{scope}[{node.name!r}]"
        if isinstance(node, nodes.Tuple):
            return f"({''.join(f'{self._target(one, scope)}, ' for one in node.items)})"
        raise UntranslatableError(type(node).__name__)

    def _include(self, node: nodes.Include, scope: int, out: int) -> Iterator[str]:
        if node.ignore_missing or not node.with_context:
            raise UntranslatableError("include")
        yield f"o{out}.append(env.included({self._value(node.template, scope)}, v{scope}))"

    def _import(self, node: nodes.Import, scope: int, out: int) -> Iterator[str]:
        del out
        module = self._module(node, scope)
        yield f"v{scope}[{node.target!r}] = {module}"

    def _fromimport(self, node: nodes.FromImport, scope: int, out: int) -> Iterator[str]:
        del out
        module = self._new()
        yield f"j{module} = {self._module(node, scope)}"
        for one in node.names:
            name, alias = one if isinstance(one, tuple) else (one, one)
            yield f"v{scope}[{alias!r}] = env.attribute(j{module}, {_public(name)!r})"

    def _module(self, node: nodes.Import | nodes.FromImport, scope: int) -> str:
        around = f"v{scope}" if node.with_context else "None"
        return f"env.module({self._value(node.template, scope)}, {around})"

    def _filterblock(self, node: nodes.FilterBlock, scope: int, out: int) -> Iterator[str]:
        inner = self._new()
        yield f"def t{inner}(v{inner}):"
        yield from _indented(self.block(node.body, inner))
        call = self._filter(node.filter, scope, f"t{inner}(v{scope}.copy())")
        yield f"o{out}.append(env.shown({call}))"

    # -- expressions

    def _value(self, node: nodes.Node, scope: int) -> str:
        write = getattr(self, f"_value_{type(node).__name__.lower()}", None)
        if isinstance(node, nodes.BinExpr) and type(node) in _BINARY:
            left, right = self._value(node.left, scope), self._value(node.right, scope)
            return f"({left} {_BINARY[type(node)]} {right})"
        if write is None:
            raise UntranslatableError(type(node).__name__)
        return str(write(node, scope))

    def _value_const(self, node: nodes.Const, scope: int) -> str:
        del scope
        return repr(node.value)

    def _value_templatedata(self, node: nodes.TemplateData, scope: int) -> str:
        del scope
        return repr(node.data)

    def _value_name(self, node: nodes.Name, scope: int) -> str:
        return f"v{scope}[{_public(node.name)!r}]"

    def _value_getattr(self, node: nodes.Getattr, scope: int) -> str:
        return f"env.attribute({self._value(node.node, scope)}, {_public(node.attr)!r})"

    def _value_getitem(self, node: nodes.Getitem, scope: int) -> str:
        if isinstance(node.arg, nodes.Slice):
            raise UntranslatableError("Slice")
        return f"env.item({self._value(node.node, scope)}, {self._value(node.arg, scope)})"

    def _value_list(self, node: nodes.List, scope: int) -> str:
        return f"[{self._values(node.items, scope)}]"

    def _value_tuple(self, node: nodes.Tuple, scope: int) -> str:
        return f"({''.join(f'{self._value(one, scope)}, ' for one in node.items)})"

    def _value_dict(self, node: nodes.Dict, scope: int) -> str:
        pairs = (
            f"{self._value(pair.key, scope)}: {self._value(pair.value, scope)}"
            for pair in node.items
        )
        return f"{{{', '.join(pairs)}}}"

    def _value_not(self, node: nodes.Not, scope: int) -> str:
        return f"(not {self._value(node.node, scope)})"

    def _value_concat(self, node: nodes.Concat, scope: int) -> str:
        return f"''.join(map(str, [{self._values(node.nodes, scope)}]))"

    def _value_compare(self, node: nodes.Compare, scope: int) -> str:
        parts = [self._value(node.expr, scope)]
        for one in node.ops:
            parts += [_COMPARED[one.op], self._value(one.expr, scope)]
        return f"({' '.join(parts)})"

    def _value_condexpr(self, node: nodes.CondExpr, scope: int) -> str:
        other = "env.nothing" if node.expr2 is None else self._value(node.expr2, scope)
        test, value = self._value(node.test, scope), self._value(node.expr1, scope)
        return f"({value} if {test} else {other})"

    def _value_test(self, node: nodes.Test, scope: int) -> str:
        asked = node.node
        if node.name == "defined" and isinstance(asked, nodes.Name):
            return f"({_public(asked.name)!r} in v{scope})"
        if node.name == "defined" and isinstance(asked, nodes.Getattr | nodes.Getitem):
            return f"env.defined(lambda: {self._value(asked, scope)})"
        raise UntranslatableError(node.name)

    def _value_call(self, node: nodes.Call, scope: int) -> str:
        return f"{self._value(node.node, scope)}({self._arguments(node, scope)})"

    def _value_filter(self, node: nodes.Filter, scope: int) -> str:
        if node.node is None:
            raise UntranslatableError("filter")
        return self._filter(node, scope, self._value(node.node, scope))

    def _filter(self, node: nodes.Filter, scope: int, value: str) -> str:
        if node.name not in FILTERS:
            raise UntranslatableError(node.name)
        rest = self._arguments(node, scope)
        return f"env.filters[{node.name!r}]({', '.join(filter(None, [value, rest]))})"

    def _arguments(self, node: nodes.Call | nodes.Filter, scope: int) -> str:
        if node.dyn_args is not None or node.dyn_kwargs is not None:
            raise UntranslatableError("*")
        named = (f"{_public(str(one.key))}={self._value(one.value, scope)}" for one in node.kwargs)
        return ", ".join([*(self._value(one, scope) for one in node.args), *named])

    def _values(self, items: Sequence[nodes.Node], scope: int) -> str:
        return ", ".join(self._value(one, scope) for one in items)


def _public(name: str) -> str:
    if name.startswith(_PRIVATE):
        raise UntranslatableError(name)
    return name
