"""Tells the type checker the types of parameter values, which rclpy does not annotate.

``self.get_parameter('rate').value`` is a float if the file declares ``rate`` with ``10.0``: rclpy
rejects values of other types. The replacement has the same length, so that locations do not change.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

from scaffold import lazy_re
from scaffold.types.rewriting.callbacks import arguments_of

_OF = "_ros2_param_"
_RECEIVER = r"(?<![\w.])(?P<receiver>(?:self\.)?\w+)"
_NAMED = r"\(\s*(?P<quote>['\"])(?P<name>[\w.]+)(?P=quote)\s*"
_ALSO_NAMED = r"\(\s*(?P<mark>['\"])(?P<declared>[\w.]+)(?P=mark)\s*"
_CONSTANT = (
    r"(?P<bool>True|False)|(?P<float>-?(?:\d+\.\d*|\.\d+|\d+(?:\.\d*)?[eE]-?\d+))"
    r"|(?P<int>-?\d+)|(?P<str>'[^'\\\n]*'|\"[^\"\\\n]*\")"
    r"|(?:\w+\.){1,3}Type\.(?P<type>BOOL|DOUBLE|INTEGER|STRING)\b"
)
_DECLARED = lazy_re.compile(
    rf"{_RECEIVER}\.declare_parameter{_NAMED}(?:,\s*(?:{_CONSTANT})?\s*(?P<next>[,)])?)?"
)
_DECLARED_TOGETHER = lazy_re.compile(rf"{_RECEIVER}\.declare_parameters\(")
_ROW = lazy_re.compile(rf"{_NAMED},\s*(?:{_CONSTANT})?\s*(?P<next>[,)])?")
_READ = lazy_re.compile(
    rf"{_RECEIVER}\.(?:get_parameter{_NAMED}|declare_parameter{_ALSO_NAMED},[^()\[\]{{}},]+)\)"
    r"\s*\.value\b(?!\s*=[^=])"
)
_TYPES = {"BOOL": "bool", "DOUBLE": "float", "INTEGER": "int", "STRING": "str"}
_EXACT = {"float": f"'_Ros2TypeOfParameter[{_OF}exact]'"}
"""Annotations that do not include int, as float does."""
_DEFINITIONS = (
    f"{_OF}exact = float()\nfrom ty_extensions._internal import TypeOf as _Ros2TypeOfParameter"
)
_UNSUITED = lazy_re.compile(rb"dynamic_typing|def (?:declare|get)_parameter\(")
_SPACE = lazy_re.compile(r"\S")


def with_types(data: bytes) -> bytes:
    """Return a file in which the values of parameters are replaced by calls with their type."""
    if not (b"declare_parameter" in data and b").value" in data) or _UNSUITED.search(data):
        return data
    try:
        text = data.decode()
    except UnicodeDecodeError:
        return data
    types = _types(text)

    def typed(match: re.Match[str]) -> str:
        type_ = types.get((match["receiver"], match["name"] or match["declared"]))
        return _of_length(f"{_OF}{type_}()", match[0]) if type_ else match[0]

    typed_text = _READ.sub(typed, text)
    functions = [
        f"def {_OF}{type_}() -> {_EXACT.get(type_, type_)}: ...\n"
        for type_ in _TYPES.values()
        if f"{_OF}{type_}(" in typed_text
    ]
    needed = [_DEFINITIONS] if functions else []
    return "\n".join([typed_text, *needed, *functions]).encode()


def _types(text: str) -> Mapping[tuple[str, str], str]:
    """Return the types of the declared parameters by receiver and name; empty if uncertain."""
    types: dict[tuple[str, str], set[str]] = {}
    for receiver, match in _declarations(text):
        types.setdefault((receiver, match["name"]), set()).add(_type(match))
    return {key: next(iter(found)) for key, found in types.items() if len(found) == 1}


def _declarations(text: str) -> Iterator[tuple[str, re.Match[str]]]:
    """Yield the declarations of parameters, each with its receiver."""
    for match in _DECLARED.finditer(text):
        yield match["receiver"], match
    for together in _DECLARED_TOGETHER.finditer(text):
        words, end = arguments_of(text, together.end())
        if words.get("0", "").strip() in {"''", '""'}:
            for match in _ROW.finditer(text, together.end(), end):
                yield together["receiver"], match


def _type(match: re.Match[str]) -> str:
    """Return the type of a declared parameter; empty if unknown."""
    if not match["next"]:
        return ""
    if match["type"]:
        return _TYPES[match["type"]]
    return next((type_ for type_ in _TYPES.values() if match[type_]), "")


def _of_length(expression: str, old: str) -> str:
    """Return an expression with the lines and the length of another one."""
    first, newline, rest = old.partition("\n")
    if not newline:
        return expression.ljust(len(old))
    if len(first) <= len(expression):
        return old
    blank = _SPACE.sub(" ", rest)
    return f"{f'({expression}'.ljust(len(first))}\n{blank[:-1]})"
