"""Formats type names of the type checker for messages."""

from __future__ import annotations

import builtins
import re

from scaffold import lazy_re
from scaffold.types.stubs.marks import MARK, MARKED, full_name, short_name

# linear: the type checker truncates types in messages
_TEXT = lazy_re.compile(r"""b?"(?:[^"\\]|\\.)*\"""")
_IDENTIFIER = lazy_re.compile(rf"[^\W\d][\w{MARK}]*")
_BUILTINS = frozenset(
    {"int", "float", "str", "bool", "bytes", "bytearray", "complex", "list", "tuple", "dict"}
    | {"set", "frozenset", "Literal", "LiteralString", "None", "True", "False", "type", "class"}
    | {"array"}
    | {
        name
        for name, value in vars(builtins).items()
        if isinstance(value, type) and issubclass(value, BaseException)
    }
)
_ANYTHING = lazy_re.compile(r"\b(?:Unknown|Any|object|Todo|Never|Divergent)\b|@|(?<!& )~")
"""Matches types of which too little is known, such as ``~None``, a narrowed ``object``."""
_CONTAINER = lazy_re.compile(r"list|dict|set|tuple")
_CLASSES = lazy_re.compile(rf"(?:{MARKED}|bytes|None)(?: \| (?:{MARKED}|bytes|None))*")
_ITERABLE = lazy_re.compile(r"\b(?:Iterable|Sequence)\[")
_INNERMOST = lazy_re.compile(r"\([^()\[\]]*\)|\[[^()\[\]]*\]")
"""Matches innermost arguments of a function or a type."""
_SEQUENCE = lazy_re.compile(r"(?:Sequence|list|tuple)\[.*\]")
_NO_SEQUENCE = lazy_re.compile(r"(?:dict|set)\[.*\]|(?:int|float|bool)\*?|Literal\[-?\d+\]")
_SCALAR = lazy_re.compile(r"(?:int|float|bool)\*?|Literal\[-?\d+\]")
_MESSAGE = lazy_re.compile(rf"[A-Z]\w*{MARK}\w+{MARK}msg{MARK}\w+")
_OMITTED = lazy_re.compile(r"\| \.\.\. omitted \d+ union elements")
_NUMBERS = lazy_re.compile(r"Supports(?:Float|Int|Index)(?: \| Supports(?:Float|Int|Index))*")
_PLAIN = lazy_re.compile(
    r"Literal\[.*\]|(?:str|bytes|int|float|bool|list|tuple|dict)\b.*", re.DOTALL
)
"""Matches types of values that are not classes."""
_PLAIN_OR_CLASS = lazy_re.compile(r"(?:str|bytes|int|float|bool)\*?|Literal\[.*\]|<class '[^']+'>")
"""Matches types of numbers, strings, and classes themselves."""
_KINDS = {'"': "str", "b": "bytes", "T": "bool", "F": "bool"}


def is_certain(type_: str) -> bool:
    """Return whether a type is a single known one: of Python or of the stubs, not a union."""
    bare = _TEXT.sub("str", type_)
    if "|" in _without_arguments(bare) or _ANYTHING.search(bare):
        return False
    return all(MARK in word or word in _BUILTINS for word in _IDENTIFIER.findall(bare))


def is_certain_misfit(expected: str, given: str) -> bool:
    """Return whether a value of one type is certainly not accepted where another is expected.

    Args:
        expected: The expected type, or several separated by ``|``.
        given: The type of the value, which the type checker has rejected.
    """
    if expected.startswith("type["):
        parts = _alternatives(_TEXT.sub("str", given))
        return all(_PLAIN.fullmatch(part.strip()) for part in parts)
    if _OMITTED.search(expected):
        return bool(class_in(given)) and is_certain(given)
    if _lacks_elements(expected, given):
        return True
    may_fit = _ITERABLE.search(expected) is not None and _is_mixed(given)
    if may_fit or not is_certain(_ITERABLE.sub("list[", expected).replace("|", ",")):
        return False
    is_container = _CONTAINER.fullmatch(_without_arguments(given)) and _CLASSES.fullmatch(expected)
    if is_container or is_certain(given) or is_function(given):
        return True  # whatever the elements of a container
    parts = [part.strip() for part in _alternatives(_TEXT.sub("str", given))]
    is_of_classes = _CLASSES.fullmatch(expected) is not None and "bytes" not in parts
    return is_of_classes and all(map(_PLAIN_OR_CLASS.fullmatch, parts))


def _lacks_elements(expected: str, given: str) -> bool:
    """Return whether a list is expected, of whatever elements, and something else is given."""
    is_single = _SCALAR.fullmatch(given) or _MESSAGE.fullmatch(given) or is_function(given)
    if _ITERABLE.match(expected) and is_single:
        return True
    is_sequence = _SEQUENCE.fullmatch(expected) and "|" not in _without_arguments(expected)
    return bool(is_sequence and _NO_SEQUENCE.fullmatch(given))


def _is_mixed(given: str) -> bool:
    """Return whether elements of a container are of several types, of which all used may fit."""
    is_container = _CONTAINER.fullmatch(_without_arguments(given)) is not None
    return is_container and len(_alternatives(given.partition("[")[2].removesuffix("]"))) > 1


def elements_misfit(expected: str, given: str) -> str:
    """Return the expected and actual element types of a list, if they certainly do not fit.

    Only messages, strings and containers count: numbers and ``None`` may be replaced one by one.
    """
    wanted = re.fullmatch(r"Iterable\[(.+)\]", expected)
    listed = re.fullmatch(rf"list\[({MARKED}|str|(?:list|dict|tuple)\[.+\])\]", given)
    if wanted is None or listed is None:
        return ""
    if _NUMBERS.fullmatch(wanted[1]):
        return f"a number, not {in_words(listed[1])}"
    if not is_certain(wanted[1]):
        return ""
    return f"{with_article(name_of(wanted[1]))}, not {in_words(listed[1])}"


def _without_arguments(type_: str) -> str:
    """Return a type without its arguments in brackets."""
    before = ""
    while before != type_:
        before, type_ = type_, re.sub(r"\[[^\[\]]*\]", "", type_)
    return type_


def is_function(type_: str) -> bool:
    """Return whether a type is a function or a method; a union has parentheses around one."""
    is_plain = type_.startswith("(") and not type_.startswith(("((", "(bound ", "(def "))
    return is_plain or re.match(r"(?:bound method|def) ", type_) is not None


def class_in(type_: str) -> str:
    """Return the marked name of the class of an instance type; empty for others."""
    match = re.fullmatch(rf"({MARKED})(?:\[.*\])?", type_, re.DOTALL)
    return match[1] if match else ""


def class_itself(type_: str) -> str:
    """Return the marked name of a class if the value is the class itself, not an instance."""
    match = re.fullmatch(rf"(?:<class '({MARKED})'>|type\[({MARKED})\])", type_)
    return (match[1] or match[2]) if match else ""


def in_words(type_: str) -> str:
    """Return the description of a value of a type: ``an int``, ``the class 'String'``."""
    if type_ == "None":
        return "None"
    literal = re.fullmatch(r"Literal\[(.).*\]", type_, re.DOTALL)
    if literal is not None:
        return with_article(_KINDS.get(literal[1], "int"))
    if class_itself(type_):
        return f"the class {short_name(class_itself(type_))!r}"
    function = re.match(r"(?:bound method|def) (?:Self@)?([\w.·]+)", type_)
    if function is not None:
        return f"the function {function[1].rpartition('.')[2]!r}"
    classes = [part.strip() for part in type_.split(" | ")]
    if all(part.startswith("<class '") for part in classes):
        return " or ".join(f"the class {part[8:-2]!r}" for part in classes)
    return with_article(name_of(type_))


def name_of(type_: str) -> str:
    """Return the name of a type without its arguments: ``list``, ``rclpy.time.Time``."""
    parts = [part.strip().rstrip("*") for part in _alternatives(_without_arguments(type_))]
    names = ["function" if "->" in part else _readable(part) for part in parts]
    *others, last = dict.fromkeys(names)
    return f"{', '.join(others)} or {last}" if others else last


def _alternatives(type_: str) -> list[str]:
    """Return the parts of a union; a function in it, ``(() -> int)``, is one of them."""
    before = ""
    bare = type_
    while before != bare:  # a function may take functions, a list may have lists
        before, bare = bare, _INNERMOST.sub(lambda match: "_" * len(match[0]), bare)
    ends = [place for place, letter in enumerate(bare) if letter == "|"]
    starts = [0, *(end + 1 for end in ends)]
    return [type_[start:end] for start, end in zip(starts, [*ends, None], strict=True)]


def _readable(name: str) -> str:
    """Return the dotted name of a type, or the description of a protocol: ``some_numbers_``."""
    plain = name.strip("()")
    if MARK not in plain:
        return "list" if plain in {"Iterable", "Sequence"} else plain
    short = short_name(plain)
    return short[:-1].replace("_", " ") if short.endswith("_") else full_name(plain)


def unlike(expected: str, given: str) -> str:
    """Return two types in words: ``an int, not a str``; for two lists, their elements."""
    needed, got = with_article(name_of(expected)), in_words(given)
    if got in {with_article(name_of(part)) for part in _alternatives(expected)}:
        needed, got = _with_elements(expected), _with_elements(given)
    return f"{needed}, not {got}"


def _with_elements(type_: str) -> str:
    """Return a container with its elements: ``a list of std_msgs.msg.String, or None``."""
    words: list[str] = []
    for part in _alternatives(type_):
        name, bracket, elements = part.strip().partition("[")
        within = f" of {name_of(elements.removesuffix(']'))}" if bracket else ""
        words.append(f"{name_of(name)}{within}")
    return with_article(", or ".join(words))


def with_article(noun: str) -> str:
    """Return a noun with ``a`` or ``an``, bytes without; rcl is pronounced with a leading R."""
    if noun == "bytes":
        return noun
    is_vowel = noun[:1].lower() in "aeio" or noun.startswith("rcl")
    return f"an {noun}" if is_vowel else f"a {noun}"
