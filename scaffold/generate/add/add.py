"""Adds a part or an extra to an existing package, and edits the files that mention it."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Container, Iterator, Mapping, Sequence
from contextlib import contextmanager
from typing import TYPE_CHECKING, NamedTuple

from scaffold.ament.copyright import REPOSITORY_FILES
from scaffold.check.fixes.overlay import Overlay
from scaffold.errors import ConflictError, InputError
from scaffold.generate import repository
from scaffold.generate.add import extension, regenerate, remarks, rendered_part
from scaffold.generate.add.rendered_part import LAUNCH, Piece, Target, Wanted
from scaffold.generate.edit.addition import Addition, ByHand
from scaffold.generate.edit.edit import edit
from scaffold.generate.edit.launch import add_to_launch
from scaffold.generate.templates.template import Role
from scaffold.generate.update.provenance import Provenance
from scaffold.model.launch.files import launch_files
from scaffold.model.package import Package
from scaffold.model.programs.executables import programs_of
from scaffold.source import MissingFileError, ParseError, ViewError

if TYPE_CHECKING:
    from scaffold.diagnostic import Diagnostic

_OF_A_DAY = r"(?i)\b\d{4}-\d{2}-\d{2}\b|(?<=copyright )(?:\(c\) )?\d{4}\b"
"""Dates and copyright years, which are ignored: a second run on another day changes nothing."""
HEADER_RULES = frozenset({"copyright-notice-missing", "license-header-unknown"})
"""Rules about missing headers, which are expected where the license is not known."""


class Added(NamedTuple):
    """A package after an addition, in memory."""

    files: Mapping[str, bytes]
    """What is written in the package: new files and those that are edited."""
    above: Mapping[str, bytes]
    """What is written at the top of the git repository that the package is in."""
    new: Sequence[str]
    """The files that are added; all others are edited."""
    executable: frozenset[str]
    notes: Mapping[str, str]
    """The purposes of new files, by path."""
    by_hand: tuple[ByHand, ...]
    start: str | None
    """The command that starts the new part."""
    package: Package
    """The package as it will be."""
    unedited: Package
    """The package with only the new files: its findings are not caused by edits."""
    remarks: tuple[str, ...]
    """Notes for the user, one line each."""
    has_header: bool
    """Whether the new files have a license header."""

    def is_expected(self, diagnostic: Diagnostic) -> bool:
        """Return whether a finding is caused by an edit left to the user."""
        if any(item.path == diagnostic.location.path for item in self.by_hand):
            return True
        in_part = diagnostic.location.path in self.new
        return in_part and not self.has_header and diagnostic.name in HEADER_RULES

    def without_own(
        self, after: Sequence[Diagnostic], unedited: Sequence[Diagnostic]
    ) -> list[Diagnostic]:
        """Return the findings caused by the edits or the new files.

        The rest is reported for existing lines, and without any edit as well: some files are
        checked only when there is a program or a launch directory. A message that
        mentions a new file reveals an incomplete edit; after a semicolon it is only advice.

        Args:
            after: The findings of the package as it will be.
            unedited: The findings of `unedited`.
        """
        remaining = Counter(map(_fingerprint, unedited))
        diagnostics: list[Diagnostic] = []
        for item in after:
            about = item.message.partition("; ")[0]
            is_ours = item.location.path in self.new or any(path in about for path in self.new)
            if not is_ours and remaining[_fingerprint(item)]:
                remaining[_fingerprint(item)] -= 1
            else:
                diagnostics.append(item)
        return diagnostics


def add(target: Target, wanted: Wanted) -> Added:
    """Add something to a package in memory.

    Args:
        target: The package as it is.
        wanted: A part or an extra.

    Raises:
        InputError: the package cannot be parsed or does not fit, an answer is not acceptable, or
            a node would not connect with another one.
        ConflictError: it has a program of that name already.
    """
    package = target.package
    with _converted_errors(package):
        _refuse_ros_1(package)
        old = regenerate.provenance_of(target)
        wanted = wanted._replace(given={**regenerate.remembered(old), **wanted.given})
        extended = extension.of(package, wanted)
        wanted = wanted._replace(given={**wanted.given, **extended.given})
        made = rendered_part.make(target, old, wanted)
        _refuse_taken(package, made)
        new = _new_files(target, old, made)
        new = {path: data for path, data in new.items() if path not in extended.files}
        others, by_hand = _other_files(target, old, made)
    left = repository.left_to_owners(
        target.place, package.name, made.rendered.files, lambda path: _content(target, path)
    )
    by_hand += tuple(filter(None, left.values()))
    new = {path: data for path, data in new.items() if path not in left}
    above, new = repository.above(new), repository.inside(new)
    # The files of the part have the date of today, those of the package keep theirs.
    files = {**repository.inside(others), **extended.files, **new}
    after = _with_files(package, files, made.rendered.executable)
    _refuse_conflicts(after, made)
    return Added(
        files,
        above,
        tuple(new),
        made.rendered.executable,
        made.rendered.notes,
        by_hand,
        _start(package, made),
        after,
        _with_files(package, new, made.rendered.executable),
        (
            *_remarks(after, made),
            *repository.unread(target.place, made.rendered.unread, package.directory),
        ),
        has_header=bool(made.composed.context["header"]),
    )


def _with_files(
    package: Package, files: Mapping[str, bytes], executable: frozenset[str]
) -> Package:
    """Return the package with some files new or changed, in memory."""
    overlay = Overlay(package.tree)
    overlay.changed.update(files)
    overlay.executable.update(executable)
    return Package(overlay, directory=package.directory, workspace=package.known_workspace)


def _refuse_ros_1(package: Package) -> None:
    tools = package.manifest.depends("buildtool_depend")
    is_ours = any(name.startswith("ament_") for name in tools)
    if "catkin" in tools and not (is_ours or package.manifest.build_type):
        raise InputError(
            f"{package.directory}: a ROS 1 package, built with catkin; `add` writes ROS 2 "
            "code; nothing was changed"
        )


@contextmanager
def _converted_errors(package: Package) -> Iterator[None]:
    """Convert errors about an unreadable package to a one-line error."""
    try:
        yield
    except ParseError as error:
        raise InputError(f"{where_and_why(package, error)}; nothing was changed") from error
    except MissingFileError as error:
        raise InputError(f"{package.directory}/{error} is missing") from error
    except ViewError as error:
        raise InputError(f"{package.directory}: {error}; nothing was changed") from error


def _new_files(target: Target, old: Provenance | None, made: Piece) -> dict[str, bytes]:
    """Return the files of the piece, without those of an extra that exist already."""
    is_there = (
        made.template.role is Role.EXTRA and old is not None and regenerate.is_noted(old, made)
    )
    result: dict[str, bytes] = {}
    for path, text in made.rendered.files.items():
        existing = _content(target, path)
        data = text.encode()
        if existing is None:
            result[path] = data
        elif (
            is_there or path in REPOSITORY_FILES or _without_dates(existing) == _without_dates(data)
        ):
            result[path] = existing
        else:
            result[path] = data
    return result


def _content(target: Target, path: str) -> bytes | None:
    """Return the content of a file in the package or at the top of its repository, if it exists."""
    if path.startswith(repository.MARK):
        return repository.read(target.place, path.removeprefix(repository.MARK))
    package = target.package
    try:
        if package.has(path):
            return package.tree.read(path)
    except OSError:
        return None
    # A tree has no hidden directories.
    return repository.read(repository.place_of_files(package.root), path)


def _other_files(
    target: Target, old: Provenance | None, made: Piece
) -> tuple[dict[str, bytes], tuple[ByHand, ...]]:
    """Return the other files that change: rendered again where possible, else edited."""
    package, addition = target.package, made.addition
    rerendered = regenerate.with_piece(target, old, made) if old else None
    if rerendered is None:
        edited = edit(package, addition)
        return {**edited.files, **_launched(package, addition, ())}, edited.by_hand
    files = {**rerendered.files, **_launched(package, addition, rerendered.files)}
    if not rerendered.edited:
        return files, ()
    edited = edit(package, addition)
    files |= {path: edited.files[path] for path in rerendered.edited & edited.files.keys()}
    return files, tuple(item for item in edited.by_hand if item.path in rerendered.edited)


def _launched(package: Package, addition: Addition, done: Container[str]) -> dict[str, bytes]:
    """Return the launch file that the user has named, with the new node in it.

    Raises:
        InputError: no edit of it is safe.
    """
    path = addition.launch
    if not path or path in done:
        return {}
    source = package.editable(path)
    outcome = add_to_launch(source, addition)
    for item in outcome.by_hand:
        raise InputError(
            f"--launch: {path} cannot be edited: {item.reason}; add `{item.line}` there yourself "
            "and omit --launch; nothing was changed"
        )
    text = outcome.source.text
    return {path: text.encode(source.encoding)} if text != source.text else {}


def _start(package: Package, made: Piece) -> str | None:
    """Return the command that starts the new part."""
    if made.built is not None:
        return f"ros2 run {package.name} {made.built}"
    launch = next((path for path in made.rendered.files if path.startswith(LAUNCH)), None)
    return f"ros2 launch {package.name} {launch.rpartition('/')[2]}" if launch else None


def where_and_why(package: Package, error: ParseError) -> str:
    """Return where a package cannot be parsed, and why."""
    at = error.location
    where = f"{package.directory}/{at.path}" if package.directory else at.path
    return f"{where}:{at.line}:{at.column}: {error.message}"


def new_diagnostics(before: Sequence[Diagnostic], after: Sequence[Diagnostic]) -> list[Diagnostic]:
    """Return the findings that a package has only after the change.

    Lines may have moved, and messages may mention what is new. A line that is added to a file
    follows the style of that file, so the style findings it already has are not new there.
    """
    from scaffold.ament.codes import STYLE
    from scaffold.diagnostic import Severity

    remaining = Counter(map(_fingerprint, before))
    styles = {
        (item.code, item.location.path)
        for item in before
        if item.code in STYLE or item.severity is not Severity.ERROR
    }
    left: list[Diagnostic] = []
    for diagnostic in after:
        if remaining[_fingerprint(diagnostic)]:
            remaining[_fingerprint(diagnostic)] -= 1
        elif (diagnostic.code, diagnostic.location.path) not in styles:
            left.append(diagnostic)
    reworded = Counter((code, path) for code, path, _ in remaining.elements())
    diagnostics: list[Diagnostic] = []
    for diagnostic in left:
        place = diagnostic.code, diagnostic.location.path
        if reworded[place]:
            reworded[place] -= 1
        else:
            diagnostics.append(diagnostic)
    return diagnostics


def _fingerprint(diagnostic: Diagnostic) -> tuple[str, str, str]:
    return diagnostic.code, diagnostic.location.path, re.sub(r"\d+", "", diagnostic.message)


def _remarks(package: Package, made: Piece) -> Iterator[str]:
    context = made.composed.context
    if not context["header"] and any(path.endswith(_WITH_HEADER) for path in made.rendered.files):
        yield f"the new files have no license header: {_why_no_header(package, made)}"
    if made.others:
        launch = next(path for path in made.rendered.files if path.startswith(LAUNCH))
        yield f"{launch} does not start {', '.join(made.others)}: not known to be nodes"
    if made.addition.program is not None:
        yield from remarks.remarks(package, made.addition.program.path)
        yield from _not_launched(package, made.addition)


def _not_launched(package: Package, addition: Addition) -> Iterator[str]:
    """Yield a note for launch files that start other nodes of the package, but not the new one."""
    program = addition.program
    if program is None or addition.launch:
        return
    others = [
        path
        for path in launch_files(package)
        if _starts_others(package.source(path).text, package.name, program.name)
    ]
    if len(others) == 1:
        yield f"{others[0]} does not start {program.name}: --launch {others[0]} would add it"
    elif others:
        yield (
            f"{len(others)} launch files do not start {program.name}, such as {others[0]}: "
            "--launch FILE would add it"
        )


def _starts_others(text: str, package: str, program: str) -> bool:
    names_package = re.search(rf"\b{re.escape(package)}\b", text) is not None
    names_program = re.search(rf"\b{re.escape(program)}\b", text) is not None
    return names_package and "ode" in text and not names_program


def _why_no_header(package: Package, made: Piece) -> str:
    if not made.composed.context["has_license"]:
        declared = ", ".join(element.text for element in package.manifest.all("license"))
        return f"the license of {package.name} is {declared or 'none'!r}; set one with --license"
    return (
        f"neither the maintainer nor the sources of {package.name} name a copyright holder; "
        "set one with --copyright-holder"
    )


_WITH_HEADER = (".py", ".cpp")
"""Files that have the header of a license."""


def _refuse_conflicts(package: Package, made: Piece) -> None:
    """Raise if a new node would not connect with an existing one."""
    program = made.addition.program
    conflicts = remarks.conflicts(package, program.path) if program is not None else ()
    for conflict in conflicts:
        raise InputError(f"{conflict}; nothing was changed")


def _refuse_taken(package: Package, made: Piece) -> None:
    """Raise if the package already has a program with the name of a new one."""
    program = made.addition.program
    if program is None:
        return
    sources = programs_of(package).sources
    if program.name in sources and sources[program.name] != program.path:
        where = f", {sources[program.name]}" if sources[program.name] else ""
        raise ConflictError(
            f"{package.name} already has a program {program.name!r}{where}; choose another name"
        )


def _without_dates(data: bytes) -> str:
    """Return a text without its dates."""
    return re.sub(_OF_A_DAY, "", data.decode(errors="replace").replace("\r\n", "\n"))
