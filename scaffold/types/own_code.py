"""Reports about classes and functions of the workspace itself, where they are certain.

Names in stubs are marked, names in user code are not: a report is about user code if an imported
file of the workspace defines the name in the message.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterable, Iterator, Sequence

from scaffold import lazy_re
from scaffold.model.python.conditions.handlers import last_name
from scaffold.model.python.module import is_in_tests
from scaffold.types.sources import Source
from scaffold.types.stubs.marks import MARK
from scaffold.types.ty import TyDiagnostic

CALLEE = r"[^\W\d]\w*(?:\.\w+)?"
_OWNER = lazy_re.compile(
    r"(?:Object of type|Class) `([^\W\d]\w*)` has no attribute `(\w+)`", re.IGNORECASE
)
# linear: the text before the name has no backquote
_CALL = lazy_re.compile(rf"[^`]*(?:`\w+`[^`]*)*? (?:[a-z]+ )*`({CALLEE})`(?:: expected .*)?")
_FOUND = lazy_re.compile(r"found `((?:Literal\[)?([A-Z][^\W_]\w*)(?:\.[^`|]*)?)`$")
"""Matches an instance of an unmarked class, or a member of an enumeration."""
_STANDING_IN = lazy_re.compile(r"Mock|Fake|Stub|Dummy", re.IGNORECASE)
"""Matches classes whose objects are passed instead of those of others."""
_SELF = lazy_re.compile(r"(?<=^Object of type `)Self@(\w+)(?=` has no attribute)")
_CLASS = lazy_re.compile(rb"([ \t]*)class (\w+)")
_GENERATED = lazy_re.compile(
    r"(Too many positional arguments)(: .*)"
    r"|No arguments? provided for required parameters? (?:`\w+`(?:, )?)+"
    r"|Argument `\w+` does not match any known parameter"
)
"""Matches reports about constructors of dataclasses and named tuples, which do not name them."""
_RECORD = (
    rb"^(?:@(?:\w+\.)?dataclass\b[^\n]*\nclass %b(?:\(\))?:|class %b\((?:\w+\.)?(NamedTuple)\):)"
)
"""Matches a dataclass without bases, which may have other fields, or a named tuple."""
_MODULE = lazy_re.compile(r"Module `([\w.]+)` has no member `\w+`")
_CALLS = frozenset(
    {
        "missing-argument",
        "too-many-positional-arguments",
        "unknown-argument",
        "parameter-already-assigned",
    }
)
_CHANGING = lazy_re.compile(
    rb"\b(?:setattr|__dict__|__getattribute__|__new__|metaclass|exec|globals|vars)\b"
)
"""Matches code that sets attributes dynamically or replaces objects."""
_LENDING = lazy_re.compile(
    rb"import[ (]*\*|\b(?:__getattr__|__import__|import_module|globals|exec)\b"
)
"""Matches code that defines names of a module dynamically or takes those of another one."""
_NAME = lazy_re.compile(rb"\b[A-Za-z_]\w*")
_DECORATOR = lazy_re.compile(rb"[ \t]*@(?:\w+\.)*(\w+)")
_DECORATORS = frozenset({b"dataclass", b"final", b"total_ordering"})
"""Decorators of classes that add no other attributes."""


def is_about_own(item: TyDiagnostic, source: Source, sources: Iterable[Source]) -> bool:
    """Return whether a report is about a class or a function that one of the files defines.

    Args:
        item: The report.
        source: The file that it is about.
        sources: That file and all that it imports.
    """
    module = _MODULE.fullmatch(item.message)
    if module is not None and item.kind == "missing-attribute":
        return _is_lacking(module[1], sources)
    name = own_name(item)
    if not name:
        return False
    files = [item.data for item in sources if item.path]
    defining = [data for data in files if _definition(name).search(data)]
    if not defining or any(_CHANGING.search(data) for data in _with_bases(name, files)):
        return False
    if item.kind == "missing-attribute" and (
        any(_is_decorated(name, data) for data in defining)
        or _is_of_derived(item, name, source.data, files)
    ):
        return False
    return item.kind in _CALLS or len(defining) == 1  # otherwise the object may be of another class


def _is_lacking(module: str, sources: Iterable[Source]) -> bool:
    """Return whether a module of the workspace certainly has only the names in its file."""
    files = [item for item in sources if item.path and item.dotted == module]
    return len(files) == 1 and not _LENDING.search(files[0].data)


def with_own_marked(item: TyDiagnostic, sources: Iterable[Source]) -> TyDiagnostic:
    """Return a report with the class of the actual value marked if a file defines it."""
    match = _FOUND.search(item.message)
    if match is None:
        return item
    definition = _definition(match[2].encode())
    defining = [it for it in sources if it.path and definition.search(it.data)]
    class_ = re.compile(rb"^class %b\b" % match[2].encode(), re.MULTILINE)
    is_one = len(defining) == 1 and class_.search(defining[0].data) is not None
    if not is_one or is_in_tests(defining[0].path) or _STANDING_IN.match(match[2]):
        return item
    stem = defining[0].path.rpartition("/")[2].removesuffix(".py")
    marked = MARK.join([match[2], *(defining[0].dotted or stem).split(".")])
    return item._replace(message=f"{item.message[: match.start(1)]}{marked}`")


def with_own_name(item: TyDiagnostic, source: Source, sources: Iterable[Source]) -> TyDiagnostic:
    """Return a report with the name of the class that it is about, if a file defines that."""
    is_call = item.kind in _CALLS
    return (_with_constructor if is_call else _with_class_of_self)(item, source, sources)


def _with_class_of_self(
    item: TyDiagnostic, source: Source, sources: Iterable[Source]
) -> TyDiagnostic:
    """Return a report about ``self`` as one about its class, if any of the files creates that.

    A class that nothing creates may be a part of others, which have the attribute.
    """
    method = _SELF.search(item.message)
    class_ = _class_around(source.data, item.line, method[1].encode()) if method else b""
    made = re.compile(rb"(?<!class )\b%b\(" % class_)
    if method is None or not class_ or not any(made.search(other.data) for other in sources):
        return item
    start, end = method.span()
    message = f"{item.message[:start]}{class_.decode()}{item.message[end:]}"
    return item._replace(message=message)


def _class_around(data: bytes, line: int, method: bytes) -> bytes:
    """Return the name of the class whose method contains a line; empty if that is uncertain."""
    lines = data.splitlines()[:line]
    heads = [match for match in map(_CLASS.match, lines) if match]
    if not heads or heads[-1][1]:
        return b""  # a nested class
    body = lines[lines.index(heads[-1].string) :]
    is_inside = any(re.match(rb"[ \t]+(?:async )?def %b\(\s*self\b" % method, it) for it in body)
    return heads[-1][2] if is_inside else b""


def _with_constructor(
    item: TyDiagnostic, source: Source, sources: Iterable[Source]
) -> TyDiagnostic:
    """Return a report about a generated constructor with its class, if a file defines that."""
    match = _GENERATED.fullmatch(item.message)
    name = _called_at(source.data, item) if match is not None else ""
    if match is None or not name:
        return item
    definition = re.compile(_RECORD % (name.encode(), name.encode()), re.MULTILINE)
    kinds = {found[1] for other in sources for found in definition.finditer(other.data)}
    if len(kinds) != 1:
        return item
    callee = f"`{name}`" if kinds.pop() is None else f"`{name}.__new__`"
    text, rest = (match[1], match[2]) if match[1] else (match[0], "")
    return item._replace(message=f"{text} {'to' if rest else 'of'} {callee}{rest}")


def _called_at(data: bytes, item: TyDiagnostic) -> str:
    """Return the name of the class or function that the innermost call around a place calls."""
    try:
        tree = ast.parse(data)
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return ""
    at = item.line, item.column - 1
    calls = [
        node
        for node in ast.walk(tree)
        if isinstance(node, ast.Call)
        and (node.lineno, node.col_offset) <= at
        and at < (node.end_lineno or 0, node.end_col_offset or 0)
    ]
    func = max(calls, key=lambda call: (call.lineno, call.col_offset)).func if calls else None
    return last_name(func) if func is not None else ""


def own_name(item: TyDiagnostic) -> bytes:
    """Return the class or function that a report may be about; empty if it is about none."""
    if item.kind == "missing-attribute":
        matched = _OWNER.fullmatch(item.message)
    elif item.kind in _CALLS:
        matched = _CALL.fullmatch(item.message)
    else:
        return b""
    return matched[1].partition(".")[0].encode() if matched is not None else b""


def _is_decorated(name: bytes, data: bytes) -> bool:
    """Return whether a decorator of a class may add attributes, such as ``@dataclass_json``."""
    for matched in _definition(name).finditer(data):
        for line in reversed(data[: matched.start()].splitlines()):
            decorator = _DECORATOR.match(line)
            if decorator is not None and decorator[1] not in _DECORATORS:
                return True
            if decorator is None and not line.lstrip().startswith(b"#"):
                break
    return False


def _is_of_derived(item: TyDiagnostic, class_: bytes, data: bytes, files: Sequence[bytes]) -> bool:
    """Return whether an object may be of a derived class: each of them has the attribute.

    Not if the base itself is created: by the file, or by any for ``self``. Other files may pass
    objects of either class.
    """
    matched = _OWNER.fullmatch(item.message)
    if matched is None:
        return False
    derived = re.compile(rb"^[ \t]*class \w+\([^()]*\b%b\b[^()]*\)" % class_, re.MULTILINE)
    made = re.compile(rb"(?<!class )\b%b\(" % class_)
    attribute = re.compile(rb"\b(?:def |self\.)%b\b" % matched[2].encode())
    with_derived = [file for file in files if derived.search(file)]
    creating = files if _definition(class_).search(data) else [data]
    return (
        bool(with_derived)
        and all(attribute.search(file) for file in with_derived)
        and not any(made.search(file) for file in creating)
    )


def _definition(name: bytes) -> re.Pattern[bytes]:
    return re.compile(
        rb"^[ \t]*(?:class %b\b(?:\(([^()]*)\))?|(?:async )?def %b\b)" % (name, name), re.MULTILINE
    )


def _with_bases(name: bytes, files: Sequence[bytes]) -> Iterator[bytes]:
    """Yield the files that define a name or, if it is a class, one of its bases."""
    names, seen = [name], {name}
    while names:
        definition = _definition(names.pop())
        for data in files:
            for matched in definition.finditer(data):
                yield data
                bases = set(_NAME.findall(matched[1] or b"")) - seen
                seen |= bases
                names += bases
