"""Edits of CMakeLists.txt that keep comments, order and formatting.

Each function returns ``None`` if the file has errors or no safe place for the edit, and no edits if
nothing is to be done.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

from scaffold.edits import Edit
from scaffold.model.cmake.lists import LAST_CALLS, CMakeLists
from scaffold.model.cmake.parser import Argument, Command

Edits = tuple[Edit, ...]

_INDENT = "  "
_LONG_LINE = 100


def insert_find_package(lists: CMakeLists, name: str, *, testing: bool = False) -> Edits | None:
    """Find a package: next to the others, in its sorted place when they are sorted.

    Args:
        lists: The file.
        name: The package.
        testing: Whether to add it inside ``if(BUILD_TESTING)``.
    """
    if lists.errors:
        return None
    if any(
        package.name == name and package.in_testing <= testing for package in lists.found_packages
    ):
        return ()
    if testing:
        return _find_in_testing(lists, name)
    return () if lists.finds_automatically else _find_at_top(lists, name)


def install_program(lists: CMakeLists, path: str) -> Edits | None:
    """Install a script where ``ros2 run`` looks for it: ``lib/${PROJECT_NAME}``.

    Args:
        lists: The file.
        path: The script, relative to the root of the package.
    """
    return _install(lists, "PROGRAMS", path, "lib")


def install_directory(lists: CMakeLists, path: str) -> Edits | None:
    """Install a directory with its name to ``share/${PROJECT_NAME}``."""
    return _install(lists, "DIRECTORY", path.rstrip("/"), "share")


def insert_before_end(lists: CMakeLists, lines: Sequence[str]) -> Edits | None:
    """Add lines as a separate block above the tests and ``ament_package()``."""
    if lists.errors:
        return None
    anchor = _end_anchor(lists)
    newline = lists.source.newline
    block = newline.join(lines)
    if anchor is None:
        text = lists.source.text
        at = len(text.rstrip())
        return (Edit(lists.source.path, at, at, f"{newline}{newline}{block}"),)
    return _block_above(lists, anchor, block)


def insert_in_testing(lists: CMakeLists, lines: Sequence[str]) -> Edits | None:
    """Add lines at the end of ``if(BUILD_TESTING)``, creating the block if there is none."""
    if lists.errors:
        return None
    newline = lists.source.newline
    block = testing_block(lists)
    if block is None:
        body = [f"{_INDENT}{line}" for line in lines]
        calls = [command for name in LAST_CALLS for command in lists.find(name)]
        anchor = next((call for call in calls if call.depth == 0), None)
        written = ["if(BUILD_TESTING)", *body, "endif()"]
        if anchor is None:
            return insert_before_end(lists, written)
        return _block_above(lists, anchor, newline.join(written))
    opener, end = block
    inside = [command for command in lists.commands if command.parent is opener]
    first = next((command for command in inside if command.branch is opener), None)
    indent = _indent_of(lists, first) if first is not None else _INDENT
    start = _line_start(lists, end.start)
    if lists.source.text[start : end.start].strip():
        return None
    text = "".join(f"{indent}{line}{newline}" for line in lines)
    return (Edit(lists.source.path, start, start, text),)


def testing_block(lists: CMakeLists) -> tuple[Command, Command] | None:
    """Return ``if(BUILD_TESTING)`` at the top level and the ``endif`` or ``else`` that ends it."""
    for opener in lists.find("if"):
        if opener.depth == 0 and opener.values == ["BUILD_TESTING"]:
            for command in lists.commands[opener.index + 1 :]:
                if command.depth == 0:
                    return opener, command
    return None


def insert_below(lists: CMakeLists, command: Command, line: str) -> Edits | None:
    """Add a line below a command, indented like it."""
    if lists.errors:
        return None
    return _insert_line_after(lists, command, f"{_indent_of(lists, command)}{line}")


def append_arguments(
    lists: CMakeLists,
    command: Command,
    last: Argument,
    values: Sequence[str],
    *,
    raw: bool = False,
) -> Edits | None:
    """Add arguments after an argument of a command, on their own lines if it has its own.

    Args:
        lists: The file.
        command: The command.
        last: The argument to add them after.
        values: The arguments.
        raw: Whether they are already quoted and escaped.
    """
    if lists.errors:
        return None
    source = lists.source
    start = _line_start(lists, last.start)
    indent = source.text[start : last.start]
    added = [value if raw else quote(value) for value in values]
    if not indent.strip() and start > command.start:
        text = "".join(f"{source.newline}{indent}{value}" for value in added)
        at = _after_comment(lists, last.end)
    else:
        text = "".join(f" {value}" for value in added)
        at = last.end
        line = source.text[start:].partition("\n")[0].rstrip()
        if len(line + text) > _LONG_LINE:
            margin = f"{source.newline}{_indent_of(lists, command)}{_INDENT}"
            text = "".join(f"{margin}{value}" for value in added)
    return (Edit(source.path, at, at, text),)


def replace_argument(lists: CMakeLists, argument: Argument, value: str) -> Edits | None:
    """Replace the value of an argument, keeping its quotes."""
    if lists.errors:
        return None
    text = f'"{value}"' if argument.quoted else quote(value)
    return (Edit(lists.source.path, argument.start, argument.end, text),)


def remove_argument(lists: CMakeLists, argument: Argument) -> Edits | None:
    """Remove an argument, with its line if it is alone there."""
    if lists.errors:
        return None
    return (_removal(lists, argument.start, argument.end),)


def quote(value: str) -> str:
    """Quote a value as an argument."""
    plain = value and not any(char in ' \t\r\n()#"\\;' for char in value)
    if plain and not value.startswith("["):
        return value
    escaped = value.replace("\\", "\\\\").replace('"', '\\"')
    return f'"{escaped}"'


# -- packages


def _find_at_top(lists: CMakeLists, name: str) -> Edits | None:
    looped = _looped_list(lists)
    if looped is not None:
        return append_arguments(lists, looped[0], looped[1], [name])
    calls = [
        command
        for command in lists.find("find_package")
        if command.depth == 0 and command.arguments and not lists.guarded_by_testing(command)
    ]
    if calls:
        return _insert_call(lists, calls, name)
    if lists.project is None:
        return None
    line = f"{lists.source.newline}find_package({name} REQUIRED)"
    return _insert_line_after(lists, lists.project, line)


def _find_in_testing(lists: CMakeLists, name: str) -> Edits | None:
    block = testing_block(lists)
    if block is not None:
        calls = [
            command
            for command in lists.find("find_package")
            if command.parent is block[0] and command.branch is block[0] and command.arguments
        ]
        if calls:
            return _insert_call(lists, calls, name)
        text = f"{lists.source.newline}{_INDENT}find_package({name} REQUIRED)"
        at = block[0].end
        return (Edit(lists.source.path, at, at, text),)
    return insert_in_testing(lists, [f"find_package({name} REQUIRED)"])


def _looped_list(lists: CMakeLists) -> tuple[Command, Argument] | None:
    """Return the ``set`` of the list of packages found in a loop, and its last element."""
    for call in lists.find("find_package"):
        loop = call.parent
        if loop is None or loop.name != "foreach" or loop.depth or not call.arguments:
            continue
        if not loop.arguments or call.arguments[0].raw != f"${{{loop.arguments[0].raw}}}":
            continue
        name = _list_name(loop)
        setters = [
            command
            for command in lists.find("set")
            if command.depth == 0 and command.values[:1] == [name] and command.index < loop.index
        ]
        if len(setters) == 1 and len(setters[0].arguments) > 1:
            return setters[0], setters[0].arguments[-1]
    return None


def _list_name(loop: Command) -> str | None:
    """Return the name of the only list of a foreach."""
    rest = [argument.raw for argument in loop.arguments[1:]]
    if rest[:2] == ["IN", "LISTS"] and len(rest) == len(("IN", "LISTS", "name")):
        return rest[2]
    if rest[:2] == ["IN", "ITEMS"]:
        rest = rest[2:]
    if len(rest) == 1 and rest[0].startswith("${") and rest[0].endswith("}"):
        return rest[0][2:-1]
    return None


def _insert_call(lists: CMakeLists, calls: Sequence[Command], name: str) -> Edits | None:
    """Add a call to the last group of similar calls."""
    source = lists.source
    like = calls[-1]
    opening = source.text[like.start : like.open_end]
    run = _last_run(lists, calls)
    names = [command.arguments[0].value for command in run]
    call = f"{opening}{name} REQUIRED)"
    # ament_cmake comes first by custom, whatever the order of the others.
    start = 1 if names[0].startswith("ament_cmake") and len(names) > 1 else 0
    if all(item <= two for item, two in pairwise(names[start:])):
        for command in run[start:]:
            if command.arguments[0].value > name and _begins_line(lists, command):
                indent = _indent_of(lists, command)
                text = f"{call}{source.newline}{indent}"
                return (Edit(source.path, command.start, command.start, text),)
    return _insert_line_after(lists, like, f"{_indent_of(lists, like)}{call}")


def _last_run(lists: CMakeLists, calls: Sequence[Command]) -> list[Command]:
    """Return the last group of calls without a blank line or another command between them."""
    run = [calls[-1]]
    for command in reversed(calls[:-1]):
        between = lists.source.text[command.end : run[0].start].replace("\r", "")
        if command.index + 1 != run[0].index or "\n\n" in between:
            break
        run.insert(0, command)
    return run


# -- installation


def _install(lists: CMakeLists, kind: str, path: str, base: str) -> Edits | None:
    if lists.errors:
        return None
    name = lists.project_name
    result = [
        install
        for install in lists.installs
        if install.kind == kind and install.command.name == "install"
    ]
    destination = f"{base}/{name}"
    if any(
        install.destination == destination and any(item.path == path for item in install.items)
        for install in result
    ):
        return ()
    for install in result:
        usable = install.command.depth == 0 and install.rename is None and not install.patterns
        if usable and name is not None and install.destination == destination and install.items:
            edits = append_arguments(lists, install.command, install.items[-1].argument, [path])
            if edits is not None:
                return edits
    return insert_install(lists, kind, path, base)


def insert_install(lists: CMakeLists, kind: str, path: str, base: str) -> Edits | None:
    """Add a separate install for a file or a directory to ``<base>/${PROJECT_NAME}``."""
    opening = "install("
    if lists.find("install"):
        like = lists.find("install")[0]
        opening = lists.source.text[like.start : like.open_end]
    lines = (
        f"{opening}",
        f"{_INDENT}{kind}",
        f"{_INDENT}{_INDENT}{quote(path)}",
        f"{_INDENT}DESTINATION {base}/${{PROJECT_NAME}}",
        ")",
    )
    return insert_before_end(lists, lines)


# -- places


def _end_anchor(lists: CMakeLists) -> Command | None:
    """Return the command to insert others before: the tests, else ament_package()."""
    calls = [
        command
        for name in LAST_CALLS
        for command in lists.find(name)
        if command.depth == 0 and _begins_line(lists, command)
    ]
    last = min(calls, key=lambda command: command.index, default=None)
    block = testing_block(lists)
    if block is None or not _begins_line(lists, block[0]):
        return last
    if last is None or block[0].index < last.index:
        return block[0]
    return last


def _block_above(lists: CMakeLists, command: Command, block: str) -> Edits:
    """Add a block, with a blank line around it, above a command and its comments."""
    newline = lists.source.newline
    at = _above_comments(lists, command)
    before = lists.source.text[_line_start(lists, at - 1) : at] if at else ""
    separator = newline if before.strip() else ""
    return (Edit(lists.source.path, at, at, f"{separator}{block}{newline}{newline}"),)


def _above_comments(lists: CMakeLists, command: Command) -> int:
    """Return the start of the comment lines right above a command, or of its own line."""
    text = lists.source.text
    at = _line_start(lists, command.start)
    while at:
        before = _line_start(lists, at - 1)
        if not text[before:at].lstrip(" \t").startswith("#"):
            break
        at = before
    return at


def _insert_line_after(lists: CMakeLists, command: Command, line: str) -> Edits:
    """Add a line below a command and the comment at the end of its line."""
    source = lists.source
    at = source.text.find("\n", command.end)
    at = len(source.text) if at < 0 else at
    if source.text[at - 1 : at] == "\r":
        at -= 1
    rest = source.text[command.end : at].strip()
    if rest and not rest.startswith("#"):
        at = command.end
    return (Edit(source.path, at, at, f"{source.newline}{line}"),)


def _after_comment(lists: CMakeLists, at: int) -> int:
    """Return the end of the comment that follows on the same line, if any."""
    text = lists.source.text
    end = text.find("\n", at)
    rest = text[at : len(text) if end < 0 else end]
    if rest.lstrip(" \t").startswith("#") and not rest.lstrip(" \t").startswith("#["):
        return at + len(rest.rstrip("\r"))
    return at


def _removal(lists: CMakeLists, start: int, end: int) -> Edit:
    text = lists.source.text
    line_start = _line_start(lists, start)
    line_end = text.find("\n", end)
    line_end = len(text) if line_end < 0 else line_end + 1
    if not text[line_start:start].strip() and not text[end:line_end].strip():
        return Edit(lists.source.path, line_start, line_end, "")
    while start > line_start and text[start - 1] in " \t":
        start -= 1
    return Edit(lists.source.path, start, end, "")


def _line_start(lists: CMakeLists, at: int) -> int:
    return lists.source.text.rfind("\n", 0, at) + 1


def _begins_line(lists: CMakeLists, command: Command) -> bool:
    return not lists.source.text[_line_start(lists, command.start) : command.start].strip()


def _indent_of(lists: CMakeLists, command: Command) -> str:
    start = _line_start(lists, command.start)
    line = lists.source.text[start : command.start]
    return line[: len(line) - len(line.lstrip(" \t"))]
