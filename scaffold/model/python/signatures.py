"""Check calls against the signatures of functions in the package."""

from __future__ import annotations

import ast


def argument_error(call: ast.Call, takes: ast.arguments, *, bound: int) -> str:
    """Return how a call does not fit the signature of the called function.

    Args:
        call: The call, without ``*`` and ``**``.
        takes: The parameters.
        bound: How many of the first ones are bound already: 1 for ``self``.

    Returns:
        Words that follow the name of the function; empty if the call fits.
    """
    positional = [*takes.posonlyargs, *takes.args][bound:]
    names = [item.arg for item in positional]
    if len(call.args) > len(names) and takes.vararg is None:
        count = len(names)
        noun = "argument" if count == 1 else "arguments"
        return f"takes {count or 'no'} {noun}, but gets {len(call.args)}"
    words = {word.arg for word in call.keywords if word.arg}
    by_name = {arg.arg for arg in (*takes.args[max(bound - len(takes.posonlyargs), 0) :],)}
    by_name |= {kwonlyarg.arg for kwonlyarg in takes.kwonlyargs}
    unknown = sorted(words - by_name)
    if unknown and takes.kwarg is None:
        return f"has no argument {unknown[0]!r}"
    needed = names[len(call.args) : len(names) - len(takes.defaults)]
    needed += [
        item.arg
        for item, default in zip(takes.kwonlyargs, takes.kw_defaults, strict=True)
        if default is None
    ]
    missing = [name for name in needed if name not in words]
    return f"is missing {', '.join(map(repr, missing))}" if missing else ""


def misfit_of_context(arguments: ast.arguments, count: int, words: set[str]) -> str:
    """Say what does not fit between a function and what an OpaqueFunction gives it.

    Args:
        arguments: The parameters of the function.
        count: How many of them are given by position, the context included.
        words: The names of what is given besides.

    Returns:
        Words that follow the name of the function; empty if the call fits.
    """
    given = [posonlyarg.arg for posonlyarg in [*arguments.posonlyargs, *arguments.args]]
    if not given and arguments.vararg is None:
        return "takes no arguments; it is given the context: TypeError"
    if count > len(given) and arguments.vararg is None:
        return f"is given context and {count - 1} more, and takes {len(given)} in all: TypeError"
    optional = len(arguments.defaults)
    needed = [name for name in given[count : len(given) - optional] if name not in words]
    needed += [
        item.arg
        for item, default in zip(arguments.kwonlyargs, arguments.kw_defaults, strict=True)
        if default is None and item.arg not in words
    ]
    if needed:
        return f"takes {needed[0]!r}, which args=[...] does not give: TypeError"
    names = {*given, *(kwonlyarg.arg for kwonlyarg in arguments.kwonlyargs)}
    unknown = sorted(words - names)
    if unknown and arguments.kwarg is None:
        return f"takes no {unknown[0]!r}, which kwargs={{...}} gives: TypeError"
    return ""
