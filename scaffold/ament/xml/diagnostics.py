"""Diagnostics for the findings of ament_xmllint: codes, messages and fixes."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping
from difflib import get_close_matches

from scaffold import lazy_re
from scaffold.ament.codes import diagnostic
from scaffold.ament.use import linter_use
from scaffold.ament.xml import xmllint
from scaffold.diagnostic import Diagnostic, Severity
from scaffold.edits import Edit, Fix, Safety
from scaffold.files.tree import MANIFEST
from scaffold.formats.xml import Attribute, Element
from scaffold.model.manifest.manifest import XmlModel
from scaffold.model.manifest.structure import (
    FORMATS,
    GROUPS,
    LIMITS,
    REQUIRED,
    Misplaced,
    Structure,
    Unknown,
    collapse,
)
from scaffold.model.manifest.values import (
    CONDITION,
    EMAIL,
    GROUP_CONDITION,
    LIMIT,
    NAME,
    URL_TYPES,
    VERSION,
    fits,
    is_uri,
)
from scaffold.model.package import Package
from scaffold.model.python.module import is_in_tests
from scaffold.source import Location

_Problem = tuple[Location, str] | tuple[Location, str, Fix | None]
_NAME_FOR_COLCON = r"[a-zA-Z0-9][a-zA-Z0-9_-]*"
"""What catkin_pkg accepts, some of it with a warning."""
_IN_EXPORT = frozenset({"architecture_independent", "build_type", "deprecated", "metapackage"})

_OF_FAST_DDS = ("<dds> after ", "<profiles> after ")
_END_OF_ROOT = "the end of the root element"
# linear: a declaration and comments end at their first end mark
_PROLOGUE = lazy_re.compile(rb"\s*(?:<\?xml[^>]*\?>)?\s*(?:<!--.*?-->\s*)*", re.DOTALL)
"""Matches the text before the first element."""


def diagnostics(package: Package, code: str) -> Iterator[Diagnostic]:
    """Yield the findings of ament_xmllint with one code.

    Raises:
        ViewError: the code is about package.xml, which is missing or unparsable.
    """
    if code == "PX050":
        problems = _unreadable(package)
    elif code in {"PX051", "PX052"}:
        problems = _schemas(package, is_checked=code == "PX051")
    elif code == "PX067":
        yield from _names(package, code)
        return
    else:
        problems = _PROBLEMS[code](package, _structure(package))
    is_harmless = code == "PX065" and _is_for_linter_alone(package)
    for problem in problems:
        reported = diagnostic(code, *problem)
        is_harmless = is_harmless or (code == "PX050" and _is_unused_file(package, reported))
        yield reported._replace(severity=Severity.WARNING) if is_harmless else reported


def _structure(package: Package) -> Structure:
    """Return the structure of the manifest; raises ViewError without a manifest."""
    return package.remember("manifest_structure", lambda: Structure(package.manifest))


def _is_unused_file(package: Package, unreadable: Diagnostic) -> bool:
    """Return whether a file is empty and never mentioned."""
    return unreadable.message == "the file is empty" and not linter_use(package, "xmllint").runs


def _is_for_linter_alone(package: Package) -> bool:
    """Return whether colcon accepts the manifest, and no linter checks its schema."""
    is_known = package.manifest.declared_format in {None, *map(str, FORMATS)}
    return is_known and not linter_use(package, "xmllint").runs


def _is_read_anyway(package: Package, path: str, message: str) -> bool:
    """Return whether the readers of a file accept its error.

    The reader of plugin descriptions (tinyxml2) accepts several elements at the top, and ``<`` in a
    value; the same reader accepts ``--`` in a comment of a behavior tree, and Fast DDS uses it to
    find its element among several. Parts of larger documents
    have several elements; the readers of launch files accept one. Only xmllint minds the version.
    """
    if message.startswith("XML has no version"):
        return True
    if message.startswith(_OF_FAST_DDS) and message.endswith(_END_OF_ROOT):
        return True
    try:
        start = package.bytes_of(path).lstrip()
    except OSError:
        return False
    if b"<BehaviorTree" in start and message.startswith('"--"'):
        return True
    if start.startswith(b"<library"):
        return True
    is_plugins = _PROLOGUE.sub(b"", start, count=1).startswith(b"<library")
    is_whole = start.startswith((b"<launch", b"<?xml")) and not is_plugins
    return message.endswith(_END_OF_ROOT) and not is_whole


def _unreadable(package: Package) -> Iterator[_Problem]:
    use = linter_use(package, "xmllint")
    for path in xmllint.of_package(package):
        if path != MANIFEST and (use.is_excluded or (use.runs and not use.covers(path))):
            continue
        if not use.runs and is_in_tests(path) and "launch" not in path:
            continue  # test data may be broken on purpose
        problem = xmllint.mistake(package, path) if path != MANIFEST else None
        if problem is not None and (use.runs or not _is_read_anyway(package, path, problem[1])):
            yield problem


def _schemas(package: Package, *, is_checked: bool) -> Iterator[_Problem]:
    for verdict in xmllint.verdicts(package):
        if verdict.is_checked is is_checked:
            yield verdict.location, verdict.message


def _misplaced(package: Package, structure: Structure) -> Iterator[_Problem]:
    fix = _reorder(package, structure) if structure.misplaced else None
    for misplaced in structure.misplaced:
        yield misplaced.elements[0].name_location, _place(misplaced), fix


def _reorder(package: Package, structure: Structure) -> Fix | None:
    from scaffold.model.manifest import edit as manifest_edit

    manifest = package.manifest
    edit = None if structure.unknown else manifest_edit.reorder(manifest.document)
    if edit is None:
        return None
    moved = range(edit.start, edit.end)
    has_comments = any(comment.start in moved for comment in manifest.comments)
    safety = Safety.UNSAFE if has_comments else Safety.SAFE
    return Fix("Reorder the elements", (edit,), safety)


def _place(misplaced: Misplaced) -> str:
    tag = misplaced.elements[0].tag
    sides = [
        f"{word} <{element.tag}> in line {element.location.line}"
        for word, element in (("after", misplaced.after), ("before", misplaced.before))
        if element is not None
    ]
    number = len(misplaced.elements)
    subject = f"<{tag}>" if number == 1 else f"<{tag}> and what follows it ({number} elements)"
    return f"{subject} must come {' and '.join(sides)}"


def _unknown(package: Package, structure: Structure) -> Iterator[_Problem]:
    for unknown in structure.unknown:
        reason, tag = _explain_element(structure, unknown)
        fix = _rename(package, unknown, tag) if tag else None
        yield unknown.element.name_location, f"<{unknown.element.tag}> {reason}", fix


def _rename(package: Package, unknown: Unknown, tag: str) -> Fix:
    from scaffold.model.manifest import edit as manifest_edit

    edits = manifest_edit.rename(package.manifest.document, unknown.element, tag)
    return Fix(f"Replace the element with <{tag}>", edits, Safety.UNSAFE)


def _explain_element(structure: Structure, unknown: Unknown) -> tuple[str, str | None]:
    """Return the reason, and the correct tag, if obvious."""
    tag, number = unknown.element.tag, structure.format
    if unknown.element is structure.root:
        return "is not <package>, the root of every manifest", None
    if unknown.since is not None:
        return f"needs format {unknown.since}, but this manifest has format {number}", None
    if tag == "run_depend":
        return f"is of format 1: in format {number} it is <exec_depend>", "exec_depend"
    if tag in _IN_EXPORT:
        return "belongs inside of <export>", None
    closest = get_close_matches(tag, structure.sections, n=1, cutoff=0.75)
    if closest:
        return f"is not known in format {number}: <{closest[0]}> is", closest[0]
    return f"is not known in format {number}", None


def _missing(_: Package, structure: Structure) -> Iterator[_Problem]:
    misspelt = {
        name
        for unknown in structure.unknown
        for name in get_close_matches(unknown.element.tag, structure.sections, n=1, cutoff=0.75)
    }
    for tag in structure.missing:
        if tag not in misspelt:
            earlier = REQUIRED[: REQUIRED.index(tag)]
            where = f"after <{earlier[-1]}>" if earlier else "at the beginning"
            yield structure.root.name_location, f"no <{tag}>: every manifest has one, {where}"


def _repeated(package: Package, structure: Structure) -> Iterator[_Problem]:
    for again, first in structure.repeated:
        fix = None
        if again.raw == first.raw:
            fix = Fix("Remove the duplicate", (package.manifest.remove(again),))
        message = f"a second <{again.tag}>: the first is in line {first.location.line}"
        yield again.name_location, message, fix


def _attributes(_: Package, structure: Structure) -> Iterator[_Problem]:
    for element, attribute in structure.unknown_attributes:
        if attribute.name != "condition":
            yield attribute.name_location, _explain_attribute(structure, element, attribute)


def _explain_attribute(structure: Structure, element: Element, attribute: Attribute) -> str:
    name, tag = attribute.name, element.tag
    if name == "xmlns":
        return f"<{tag}> gets a namespace: the elements of a manifest have none"
    if (tag, name) == ("license", "file"):
        return f"<license file> needs format 3, but this manifest has format {structure.format}"
    if (tag, name) == ("version", "compatibility"):
        return "<version compatibility> is in REP 149, but ament_xmllint's schema rejects it"
    allowed = structure.attributes(element)
    closest = get_close_matches(name, allowed, n=1)
    if closest:
        return f'<{tag}> has no attribute "{name}": it has "{closest[0]}"'
    if allowed:
        return f'<{tag}> has no attribute "{name}", only {", ".join(allowed)}'
    return f'<{tag}> has no attributes in format {structure.format}, so no "{name}"'


def _format(package: Package, structure: Structure) -> Iterator[_Problem]:
    manifest = package.manifest
    declared, root = manifest.declared_format, structure.root
    if declared is not None and declared not in map(str, FORMATS):
        at = root.attributes["format"].location
        yield at, f'format="{declared}" does not exist: there are 1, 2 and 3'
        return
    for model in manifest.xml_models:
        named = re.search(r"package_format([0-9]+)\.xsd", model.href or "")
        if named is None or named[1] == (declared or "1"):
            continue
        if declared is None:
            message = f"no format: that is format 1, but the schema named is format {named[1]}"
            yield root.name_location, message
        else:
            message = f"names the schema of format {named[1]}, but <package> has {declared}"
            yield model.location, message, _name_schema(package, model, declared)


def _name_schema(package: Package, model: XmlModel, declared: str) -> Fix:
    source, instruction = package.manifest.source, model.instruction
    start = source.text.index("package_format", instruction.start) + len("package_format")
    end = source.text.index(".xsd", start)
    return Fix(f"Use the schema of format {declared}", (Edit(source.path, start, end, declared),))


def _texts(_: Package, structure: Structure) -> Iterator[_Problem]:
    for at in structure.stray_texts:
        yield at, "text between the elements: only comments are allowed"


def _names(package: Package, code: str) -> Iterator[Diagnostic]:
    for element, name in _structure(package).values("name"):
        if not fits(NAME, name):
            severity = Severity.ERROR if _is_refused(package, name) else Severity.WARNING
            message = f"the name {name!r} {_explain_name(name)}"
            yield diagnostic(code, element.text_location, message, severity=severity)


def _is_refused(package: Package, name: str) -> bool:
    """Return whether colcon, the generators of interfaces or a test reject a malformed name."""
    if not fits(_NAME_FOR_COLCON, name) or linter_use(package, "xmllint").runs:
        return True
    return any(package.glob(f"{kind}/*.{kind}") for kind in ("msg", "srv", "action"))


def _explain_name(name: str) -> str:
    if not name:
        return "is empty"
    wrong = sorted({c for c in name if not (c.isascii() and (c.isalnum() or c == "_"))})
    if wrong:
        shown = " ".join("a space" if c == " " else c for c in wrong)
        return f"has {shown} in it: only a to z, 0 to 9 and _ are allowed"
    if name != name.lower():
        return f"has capitals in it: write {name.lower()!r}"
    if not name[0].isalpha():
        return "does not begin with a letter"
    return "has an underscore at its end or two in a row"


def _versions(_: Package, structure: Structure) -> Iterator[_Problem]:
    for element, version in structure.values("version"):
        if not fits(VERSION, version):
            has_zero = fits(r"[0-9]+\.[0-9]+\.[0-9]+", version)
            reason = "has a leading zero" if has_zero else "is not MAJOR.MINOR.PATCH"
            yield element.text_location, f"the version {version!r} {reason}"


def _url_types(_: Package, structure: Structure) -> Iterator[_Problem]:
    for element in structure.known:
        if element.tag != "url" or element.get("type") is None:
            continue
        attribute = element.attributes["type"]
        kind = collapse(attribute.value)
        if kind not in URL_TYPES:
            closest = get_close_matches(kind, URL_TYPES, n=1)
            hint = f": {closest[0]} is" if closest else f", only {', '.join(URL_TYPES)}"
            yield attribute.location, f"the url type {kind!r} is not known{hint}"


def _limits(_: Package, structure: Structure) -> Iterator[_Problem]:
    for element in structure.known:
        if element.tag not in structure.dependency_tags:
            continue
        for name, attribute in element.attributes.items():
            if name in LIMITS and not fits(LIMIT, " ".join(attribute.value.split())):
                message = f'{name}="{attribute.value}" is not one to three numbers'
                yield attribute.location, message


def _conditions(_: Package, structure: Structure) -> Iterator[_Problem]:
    for element, attribute in structure.unknown_attributes:
        if attribute.name == "condition":
            if structure.format < FORMATS[-1]:
                message = (
                    f"conditions need format 3, but this manifest has format {structure.format}"
                )
            else:
                message = f"<{element.tag}> has no condition: only dependencies and groups have"
            yield attribute.name_location, message
    for element in structure.known:
        if "condition" not in structure.attributes(element) or element.get("condition") is None:
            continue
        attribute = element.attributes["condition"]
        is_group = element.tag in GROUPS
        if not fits(GROUP_CONDITION if is_group else CONDITION, collapse(attribute.value)):
            elements = "groups" if is_group else "dependencies"
            reason = f"the schema does not allow all of these characters for {elements}"
            yield attribute.location, f"{attribute.value!r}: {reason}"


def _no_email(_: Package, structure: Structure) -> Iterator[_Problem]:
    for element in structure.known:
        if element.tag == "maintainer" and element.get("email") is None:
            yield element.name_location, f"the maintainer {element.text!r} has no email"


def _emails(_: Package, structure: Structure) -> Iterator[_Problem]:
    for element in structure.known:
        if element.tag not in {"maintainer", "author"} or element.get("email") is None:
            continue
        attribute = element.attributes["email"]
        if not fits(EMAIL, collapse(attribute.value)):
            yield attribute.location, f"{attribute.value!r} is not an email address"


def _nested(_: Package, structure: Structure) -> Iterator[_Problem]:
    for child, parent in structure.nested:
        message = f"<{child.tag}> is inside <{parent.tag}>, which holds text only"
        yield child.name_location, message


def _urls(_: Package, structure: Structure) -> Iterator[_Problem]:
    for element, url in structure.values("url"):
        if not is_uri(url):
            yield element.text_location, f"{url!r} is not a URL"


_PROBLEMS: Mapping[str, Callable[[Package, Structure], Iterator[_Problem]]] = {
    "PX060": _misplaced,
    "PX061": _unknown,
    "PX062": _missing,
    "PX063": _repeated,
    "PX064": _attributes,
    "PX065": _format,
    "PX066": _texts,
    "PX068": _versions,
    "PX069": _url_types,
    "PX070": _limits,
    "PX071": _conditions,
    "PX072": _no_email,
    "PX073": _emails,
    "PX074": _nested,
    "PX075": _urls,
}
