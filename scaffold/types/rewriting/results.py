"""Return types of unannotated functions that do not depend on arguments.

Examples are ``return self.x, self.y`` and ``return Pose()``, and the results of some ROS methods.
"""

from __future__ import annotations

import ast
import re
from collections import Counter
from collections.abc import Iterator

from scaffold import lazy_re
from scaffold.types.rewriting.callbacks import function_body
from scaffold.types.rewriting.statements import definitions

_ANY = "_Ros2Any"
_FUNCTION = lazy_re.compile(
    r"^(?P<indent>[ \t]*)def (?P<name>[^\W\d]\w*)"
    r"(?P<parameters>\((?:[^()]|\([^()]*\)){0,800}\))(?P<end>[ \t]*):[ \t]*(?:#[^\n]*)?$",
    re.MULTILINE,
)
"""Matches the head of a function without a return annotation."""
_NAMED = lazy_re.compile(r"\bdef (\w+)\(")
_OTHER_SCOPES = lazy_re.compile(r"^[ \t]*(?:(?:async )?def|class)\b|\byield\b", re.MULTILINE)
_RETURN = lazy_re.compile(r"(?:^[ \t]*|[:;][ \t]*)return\b[ \t]*", re.MULTILINE)
_CLASS = lazy_re.compile(r"(?:[^\W\d]\w*\.){0,4}[A-Z]\w*")
_KNOWN = (
    (
        lazy_re.compile(r"(?:self\.)?\w{0,40}buffer\w{0,40}\.lookup_transform", re.IGNORECASE),
        "_Ros2TransformStamped",
        "from geometry_msgs.msg import TransformStamped as _Ros2TransformStamped",
    ),
    (
        lazy_re.compile(r"(?:\w+\.){1,3}get_clock\(\)\.now"),
        "_Ros2Time",
        "from rclpy.time import Time as _Ros2Time",
    ),
    (
        lazy_re.compile(r"(?:\w+\.){1,3}get_clock\(\)\.now\(\)\.to_msg"),
        "_Ros2Stamp",
        "from builtin_interfaces.msg import Time as _Ros2Stamp",
    ),
)
"""Methods whose name determines the return type, with that type and its import."""
_CLOSING = {"(": ")", "[": "]", "{": "}"}
_MIN_ELEMENTS = 2


def imports(text: str) -> str:
    """Return the imports for the types of `plain_result`, to append to the file."""
    lines = [line for _, name, line in _KNOWN if f'"{name}"' in text]
    if f"tuple[{_ANY}" in text:
        lines.append(f"from typing import Any as {_ANY}")
    return "".join(f"\n{line}\n" for line in lines)


def functions(text: str) -> Iterator[re.Match[str]]:
    """Yield the heads of functions without decorators and return annotations.

    The groups are ``indent``, ``name`` and ``parameters`` (with brackets).
    """
    count = Counter(_NAMED.findall(text))
    for match in definitions(_FUNCTION, text):
        if _is_decorated(text, match.start()):
            continue
        if match["indent"] and count[match["name"]] > 1:
            continue  # a class may have another method of this name
        yield match


def body_of(text: str, function: re.Match[str]) -> str:
    """Return the body of a function."""
    return function_body(text, function.start("name"), function.end())


def _is_decorated(text: str, start: int) -> bool:
    before = text[text.rfind("\n", 0, max(start - 1, 0)) + 1 : max(start - 1, 0)].strip()
    return before.startswith("@") or before == ")"


def plain_result(parameters: str, body: str) -> str:
    """Return the type of all values that a function returns; empty if it is not plain."""
    types = {_type(value) for value in returned(parameters, body)}
    return types.pop() if len(types) == 1 else ""


def returned(parameters: str, body: str) -> list[ast.expr | None]:
    """Return what a function returns besides ``None``; local variables are resolved.

    Empty for a generator and for a function with nested scopes, and ``None`` for a value that
    is not plain.
    """
    if "return" not in body or _has_other_scopes(body):
        return []
    values = (expression_at(body, match.end()) for match in _RETURN.finditer(body))
    nodes = [_parsed(value) for value in values if value not in {"", "None"}]
    return [
        _parsed(_made(node.id, parameters, body)) if isinstance(node, ast.Name) else node
        for node in nodes
    ]


def _has_other_scopes(body: str) -> bool:
    """Return whether a function is a generator, or has nested functions or classes."""
    if not any(word in body for word in ("def", "class", "yield")):
        return False
    return _OTHER_SCOPES.search(body) is not None


def expression_at(text: str, start: int) -> str:
    """Return an expression up to the end of its line or of its brackets."""
    open_: list[str] = []
    quote = ""
    at = start
    while at < len(text):
        character = text[at]
        if quote:
            if character == "\\":
                at += 1
            elif character in {quote, "\n"}:
                quote = ""
        elif character == "\\":
            at += 1  # the expression continues
        elif character in "'\"":
            quote = character
        elif character in _CLOSING:
            open_.append(_CLOSING[character])
        elif open_ and character == open_[-1]:
            open_.pop()
        elif not open_ and character in "\n#;":
            break
        at += 1
    return text[start:at].strip()


def _type(node: ast.expr | None) -> str:
    """Return the type of an expression: of a tuple or of a constructor call; otherwise empty."""
    if isinstance(node, ast.Tuple):
        is_plain = not any(isinstance(item, ast.Starred) for item in node.elts)
        items = ", ".join([_ANY] * len(node.elts))
        return f"tuple[{items}]" if is_plain and len(node.elts) >= _MIN_ELEMENTS else ""
    class_ = ast.unparse(node.func) if isinstance(node, ast.Call) else ""
    for called, name, _ in _KNOWN:
        if called.fullmatch(class_):
            return name
    return class_ if _CLASS.fullmatch(class_) else ""


def _parsed(value: str) -> ast.expr | None:
    try:
        return ast.parse(f"({value}\n)", mode="eval").body
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return None


def _made(name: str, parameters: str, body: str) -> str:
    """Return the only value assigned to a local variable; empty if there are several."""
    if re.search(rf"\b{name}\b", parameters):
        return ""
    bound = rf"(?<![\w.]){name}\b[ \t]*(?:[,:][^=\n]*)?[-+*/|&%]?=(?!=)"
    others = rf"\b(?:for|as|global|nonlocal|import|del)\b[^\n:]*\b{name}\b|\b{name}[ \t]*:="
    plain = re.compile(rf"^[ \t]*{name}[ \t]*=(?!=)[ \t]*", re.MULTILINE)
    values = [*plain.finditer(body)]
    if len(values) != 1 or len(re.findall(bound, body)) != 1 or re.search(others, body):
        return ""
    return expression_at(body, values[0].end())
