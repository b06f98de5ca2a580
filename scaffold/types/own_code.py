"""Reports about classes and functions of the workspace itself, where they are certain.

Names in stubs are marked, names in user code are not: a report is about user code if an imported
file of the workspace defines the name in the message.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence

from scaffold import lazy_re
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


def is_about_own(item: TyDiagnostic, sources: Iterable[Source]) -> bool:
    """Return whether a report is about a class or a function that one of the files defines."""
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
        any(_is_decorated(name, data) for data in defining) or _is_of_derived(item, name, files)
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


def _is_of_derived(item: TyDiagnostic, class_: bytes, files: Sequence[bytes]) -> bool:
    """Return whether every derived class has an attribute, and nothing creates the base itself."""
    matched = _OWNER.fullmatch(item.message)
    if matched is None:
        return False
    derived = re.compile(rb"^[ \t]*class \w+\([^()]*\b%b\b[^()]*\)" % class_, re.MULTILINE)
    made = re.compile(rb"(?<!class )\b%b\(" % class_)
    attribute = re.compile(rb"\b(?:def |self\.)%b\b" % matched[2].encode())
    with_derived = [data for data in files if derived.search(data)]
    return (
        bool(with_derived)
        and all(attribute.search(data) for data in with_derived)
        and not any(made.search(data) for data in files)
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
