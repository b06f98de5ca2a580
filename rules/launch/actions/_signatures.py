"""Checks calls against the signatures of functions in the package."""

from __future__ import annotations

import ast


def misfit_of_context(arguments: ast.arguments, count: int, words: set[str]) -> str:
    """Describe the mismatch between a function and its arguments from an OpaqueFunction.

    Args:
        arguments: The parameters of the function.
        count: The number of positional arguments, including the context.
        words: The names of the keyword arguments.

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
