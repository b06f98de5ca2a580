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
_C_MACROS = frozenset(
    {"BUFSIZ", "CLOCKS_PER_SEC", "EOF", "EXIT_FAILURE", "EXIT_SUCCESS", "NULL", "RAND_MAX"}
    | {"SEEK_CUR", "SEEK_END", "SEEK_SET", "SIZE_MAX"}
    | {f"{kind}{bits}_MAX" for kind in ("INT", "UINT") for bits in (8, 16, 32, 64)}
    | {f"INT{bits}_MIN" for bits in (8, 16, 32, 64)}
)
"""Macros of the headers that generated C++ code includes."""


def reserved(name: str) -> str:
    """Return why a field cannot have a name; empty if it can."""
    if name in _C_KEYWORDS:
        return f"{name!r} is a keyword of C or C++: the generated code does not compile"
    if name in _PYTHON_KEYWORDS:
        return f"{name!r} is a keyword of Python: 'message.{name}' is a SyntaxError"
    return ""


def reserved_constant(name: str) -> str:
    """Return why a constant cannot have a name; empty if it can."""
    import errno

    if name in _C_MACROS or name in errno.errorcode.values():
        return f"{name!r} is a macro of C: the generated C++ code does not compile"
    return ""


def reserved_type(name: str) -> str:
    """Return why an interface cannot have a name; empty if it can."""
    if name in {"None", "True", "False"}:
        return f"{name!r} is a keyword of Python: the generated module is a SyntaxError"
    if name in _C_MACROS:
        return f"{name!r} is a macro of C: the generated C++ code does not compile"
    return ""


def escape_problem(text: str) -> str:
    """Return the problem with the backslashes of a text, which rosidl reads as escapes."""
    import warnings

    if "\\" not in text:
        return ""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of \d, which is kept
        try:
            read = text.encode().decode("unicode_escape")
        except UnicodeDecodeError as error:
            return error.reason
    return "its \\n ends the line in the middle of a text" if "\n" in read else ""
