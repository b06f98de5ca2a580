"""Adds a part to an existing package: renders its files, edits those that must know of it."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from datetime import date
from typing import TYPE_CHECKING, Any, NamedTuple

from scaffold.check.fixer import Overlay
from scaffold.errors import ConflictError, InputError, MissingFileError, ParseError, ViewError
from scaffold.generate import facts, licenses, own, parts
from scaffold.generate.context import part_scopes
from scaffold.generate.defaults import User
from scaffold.generate.draft import Composed, compose
from scaffold.generate.edit.addition import Addition, ByHand, Compiled, Program
from scaffold.generate.edit.edit import README, edit
from scaffold.generate.edit.layout import Layout, layout_of
from scaffold.generate.questions import Given
from scaffold.generate.render import Rendered
from scaffold.generate.template import BASE, ENDING, PARTS, Role, Template
from scaffold.model.package import Package
from scaffold.model.package_programs import programs_of

if TYPE_CHECKING:
    from scaffold.check.diagnostic import Diagnostic

_TESTS = "test"
_OF_A_DAY = r"(?i)\b\d{4}-\d{2}-\d{2}\b|(?<=copyright )(?:\(c\) )?\d{4}\b"
"""Dates, and the years of copyright notices: a second run on another day changes nothing."""
HEADER_RULES = frozenset({"copyright-notice-missing", "licence-header-unknown"})
"""What the checker finds in files without a header; where the licence is not known that is so."""


class Added(NamedTuple):
    """A package with something new, in memory."""

    files: Mapping[str, bytes]
    """What is written: new files and those that are edited."""
    new: Sequence[str]
    """The files of the part; all others are edited."""
    executable: frozenset[str]
    notes: Mapping[str, str]
    """What a new file is for."""
    by_hand: tuple[ByHand, ...]
    program: str | None
    """What ``ros2 run`` calls the new program."""
    package: Package
    """The package as it will be."""
    answers: Mapping[str, Any]
    """The part as in an answers file."""
    remarks: tuple[str, ...]
    """What the user should know, a line each."""
    has_header: bool
    """Whether the new files have a licence header."""

    def is_expected(self, diagnostic: Diagnostic) -> bool:
        """Tell whether a finding follows from what the user is told, or is left to do."""
        if any(one.path == diagnostic.location.path for one in self.by_hand):
            return True
        in_part = diagnostic.location.path in self.new
        return in_part and not self.has_header and diagnostic.name in HEADER_RULES


def add(
    package: Package,
    part: tuple[str, str],
    given: Mapping[str, Given],
    roots: Sequence[str],
    templates: Mapping[str, Template],
    user: User,
) -> Added:
    """Add a part to a package in memory.

    Args:
        package: The package as it is.
        part: Its kind and its name.
        given: The user's answers; the package answers what it has decided.
        roots: The ``templates`` directories; a later one wins.
        templates: The templates in them.
        user: Knows what neither says.

    Raises:
        InputError: the package cannot be parsed or does not fit, or an answer is not acceptable.
        ConflictError: it has a program of that name already.
    """
    try:
        return _add(package, part, given, roots, templates, user)
    except ParseError as error:
        raise InputError(f"{told(package, error)}; nothing was changed") from error
    except MissingFileError as error:
        raise InputError(f"{package.directory}/{error} is missing") from error
    except ViewError as error:
        raise InputError(f"{package.directory}: {error}; nothing was changed") from error


def _add(
    package: Package,
    part: tuple[str, str],
    given: Mapping[str, Given],
    roots: Sequence[str],
    templates: Mapping[str, Template],
    user: User,
) -> Added:
    layout, old = layout_of(package), own.provenance_of(package)
    answers = {**own.remembered(old), **given}
    composed = _compose(package, part, answers, roots, templates, user)
    rendered = _placed(composed, package, layout)
    addition = _addition(composed, package, layout, rendered)
    _refuse_taken(package, addition)
    new = {path: _kept(package, path, text) for path, text in rendered.files.items()}
    whole = own.as_new(package, old, composed, roots, templates, user) if old else None
    by_hand: tuple[ByHand, ...] = ()
    if whole is not None:
        # The files of the part have the date of today, those of the package keep theirs.
        files = {**{path: text.encode() for path, text in whole.items()}, **new}
    else:
        edited = edit(package, addition)
        files, by_hand = {**new, **edited.files}, edited.by_hand
        if old is not None:
            then = _compose(package, part, answers, roots, templates, user, old.date)
            files |= own.noted(old, composed, _placed(then, package, layout), addition)
    overlay = Overlay(package.tree)
    overlay.changed.update(files)
    overlay.executable.update(rendered.executable)
    return Added(
        files,
        tuple(new),
        rendered.executable,
        rendered.notes,
        by_hand,
        addition.program.name if addition.program else _built(composed),
        Package(overlay, directory=package.directory, workspace=package.known_workspace),
        composed.answers[parts.ADD][0],
        tuple(_remarks(package, composed, addition.program.path if addition.program else "")),
        has_header=bool(composed.context["header"]),
    )


def told(package: Package, error: ParseError) -> str:
    """Return where a package cannot be parsed, and why."""
    at = error.location
    where = f"{package.directory}/{at.path}" if package.directory else at.path
    return f"{where}:{at.line}:{at.column}: {error.message}"


def new_diagnostics(before: Sequence[Diagnostic], after: Sequence[Diagnostic]) -> list[Diagnostic]:
    """Return what the checker says of a package only now.

    Lines may have moved; and a line that is added to a file follows the style of that file, so
    what is found of style there already is not new.
    """
    from scaffold.check.diagnostic import Severity
    from scaffold.style.codes import CODES

    known = Counter(map(_said, before))
    styles = {
        (one.code, one.location.path)
        for one in before
        if one.code in CODES or one.severity is not Severity.ERROR
    }
    found: list[Diagnostic] = []
    for diagnostic in after:
        if known[_said(diagnostic)]:
            known[_said(diagnostic)] -= 1
        elif (diagnostic.code, diagnostic.location.path) not in styles:
            found.append(diagnostic)
    return found


def _said(diagnostic: Diagnostic) -> tuple[str, str, str]:
    return diagnostic.code, diagnostic.location.path, re.sub(r"\d+", "", diagnostic.message)


def _compose(
    package: Package,
    part: tuple[str, str],
    given: Mapping[str, Given],
    roots: Sequence[str],
    templates: Mapping[str, Template],
    user: User,
    day: date | None = None,
) -> Composed:
    kind, name = part
    decided = facts.answers(package, licenses.names(roots))
    has_license = "license" in {**decided, **given}
    wanted = Given([{parts.KIND: kind, "name": name}], "NAME")
    answers = {**decided, **given, parts.ADD: wanted}
    fixed = {"package": package.name, "build_type": package.build_type}
    answers["build_type"] = Given(package.build_type, "package.xml")
    messages = [path[len("msg/") : -len(".msg")] for path in package.glob("msg/*.msg")]
    composed = compose(roots, templates, answers, user, day=day, fixed=fixed, messages=messages)
    if not has_license:
        # Better the header of the author's other files, or none, than one with another licence.
        composed.context["header"] = facts.own_header(package)
    return composed


def _placed(composed: Composed, package: Package, layout: Layout) -> Rendered:
    """Render the files of the part alone, at the places where the package has such files."""
    scopes = [
        (layer, scope)
        for layer, scope in part_scopes(composed.layers, composed.context)
        if layer.role in PARTS
    ]
    rendered = composed.renderer.package(scopes)

    def place(path: str) -> str:
        for old, new in ((package.name, layout.programs), (_TESTS, layout.tests)):
            if path.startswith(f"{old}/"):
                return f"{new}/{path.removeprefix(f'{old}/')}"
        return path

    files = {place(path): _without_gap(text) for path, text in rendered.files.items()}
    if any(path.startswith(f"{layout.programs}/") for path in files):
        files |= dict.fromkeys(layout.new_files, "")
    return Rendered(
        files,
        frozenset(map(place, rendered.executable)),
        {place(path): note for path, note in rendered.notes.items()},
    )


def _without_gap(text: str) -> str:
    """Take out the blank lines that an empty header leaves at the start of a file."""
    return re.sub(r"\A(#!.*\n)?\n+", r"\1", text) if re.match(r"(#!.*\n)?\n", text) else text


def _addition(composed: Composed, package: Package, layout: Layout, rendered: Rendered) -> Addition:
    context, renderer = composed.context, composed.renderer
    scope = next(s for layer, s in part_scopes(composed.layers, context) if layer.role in PARTS)
    layer = next(layer for layer in composed.layers if layer.role in PARTS)
    depends = {
        kind: [name for text in texts for name in renderer.text(text, scope).split()]
        for kind, texts in layer.depends.items()
    }
    tests = [path for path in rendered.files if path.startswith(f"{layout.tests}/test_")]
    changelog = renderer.file(f"{BASE}/CHANGELOG.rst{ENDING}", context)
    addition = Addition(
        package.name,
        test=tests[0] if tests else None,
        depends=depends,
        groups=[renderer.text(text, scope) for text in layer.groups],
        directories=[renderer.text(text, scope) for text in layer.installs],
        readme=renderer.file(f"{BASE}/{README}{ENDING}", context),
        changes=[line for line in changelog.splitlines() if line.startswith("* ")],
    )
    if layer.role is Role.NODE:
        node = scope["node"]
        path = next(iter(sorted(rendered.executable)))
        module = f"{layout.module}.{node['module']}" if layout.module else node["module"]
        return addition._replace(program=Program(path, node["executable"], module))
    if layer.role is Role.INTERFACE:
        return addition._replace(
            interfaces=[scope["interface"]["file"]],
            interface_depends=[n for n in depends.get("depend", ()) if n != package.name],
        )
    name = str(scope["program"]["name"])
    source = next(path for path in rendered.files if path.startswith("src/"))
    return addition._replace(compiled=Compiled(name, source))


def _built(composed: Composed) -> str | None:
    """Return the name of a program that is compiled."""
    return next((str(program["name"]) for program in composed.context["programs"]), None)


def _remarks(package: Package, composed: Composed, path: str) -> Iterator[str]:
    if not composed.context["header"]:
        declared = ", ".join(element.text for element in package.manifest.all("license"))
        yield (
            f"the new files have no licence header: the licence of {package.name} is "
            f"{declared or 'none'!r}; --license gives them one"
        )
    names = [str(node["name"]) for node in composed.context["nodes"]]
    for module in package.rclpy_files():
        for node in module.nodes if module.module.path != path else ():
            if node.node_name in names:
                at = node.node_name_location
                yield (
                    f"{at.path}:{at.line} makes a node with the name {node.node_name!r}, too: "
                    "nodes that run together need names of their own"
                )


def _refuse_taken(package: Package, addition: Addition) -> None:
    """Raise if ``ros2 run`` knows another program by the name of a new one."""
    program = addition.program
    if program is None:
        return
    sources = programs_of(package).sources
    if program.name in sources and sources[program.name] != program.path:
        where = f", {sources[program.name]}" if sources[program.name] else ""
        raise ConflictError(
            f"{package.name} has a program {program.name!r} already{where}: choose another name"
        )


def _kept(package: Package, path: str, text: str) -> bytes:
    """Return a file as it is when it differs in nothing but dates, else the new text."""
    data = text.encode()
    try:
        there = package.tree.read(path) if package.has(path) else data
    except OSError:
        return data
    return there if _timeless(there) == _timeless(data) else data


def _timeless(data: bytes) -> str:
    return re.sub(_OF_A_DAY, "", data.decode(errors="replace").replace("\r\n", "\n"))
