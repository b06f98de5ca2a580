"""Names that interfaces cannot use, because the generated code would not compile."""

from __future__ import annotations

_C_KEYWORDS = frozenset(
    """
    and asm auto bitand bitor bool break case catch char class compl const constexpr continue
    decltype default delete do double else enum explicit export extern false float for friend goto
    if inline int long mutable namespace new noexcept not nullptr operator or private protected
    public register return short signed sizeof static struct switch template this throw true try
    typedef typeid typename union unsigned using virtual void volatile while xor
    """.split()  # noqa: SIM905  eighty quoted names would hide them
)
_PYTHON_KEYWORDS = frozenset(
    """
    as assert async await def del elif except finally from global import in is lambda nonlocal
    pass raise with yield
    """.split()  # noqa: SIM905  likewise
)


def reserved(name: str) -> str:
    """Return why a field cannot have a name; empty if it can."""
    if name in _C_KEYWORDS:
        return f"{name!r} is a keyword of C or C++: the generated code does not compile"
    if name in _PYTHON_KEYWORDS:
        return f"{name!r} is a keyword of Python: 'message.{name}' is a SyntaxError"
    return ""
