"""LF080: a static transform is described with names."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Sequence

from scaffold.api import Diagnostic, Edit, Example, Fix, Location, Package, Report, Rule
from scaffold.api.distributions import of_kind, target
from scaffold.api.launch import NODES, LaunchFile, markup_files

_LAUNCH = (
    "from launch import LaunchDescription\nfrom launch_ros.actions import Node\n\n\n"
    "def generate_launch_description():\n"
    "    return LaunchDescription([\n"
    "        Node(package='tf2_ros', executable='static_transform_publisher',\n"
    "             arguments=[{}]),\n    ])\n"
)
_XML = "<launch>\n  <node pkg='tf2_ros' exec='static_transform_publisher' args='{}'/>\n</launch>\n"
_OLD = "'1', '0', '0', '0', '0', '0', 'base', 'laser'"
_NEW = (
    "'--x', '1', '--y', '0', '--z', '0', '--yaw', '0', '--pitch', '0', '--roll', '0', "
    "'--frame-id', 'base', '--child-frame-id', 'laser'"
)
_LINES = (
    "\n                 '--x', '1',\n                 '--y', '0',\n                 '--z', '0',"
    "\n                 '--yaw', '0',\n                 '--pitch', '0',"
    "\n                 '--roll', '0',\n                 '--frame-id', 'base',"
    "\n                 '--child-frame-id', 'laser',\n             "
)
_ROOMY = (
    "\n  {}'1', {}'0', {}'0',\n  {}'0', {}'0', {}'0',  # of yaw first\n  {}'base',\n  {}'laser'"
)
_FRAMES = ("--frame-id", "--child-frame-id")
_FLAGS = {
    8: ("--x", "--y", "--z", "--yaw", "--pitch", "--roll", *_FRAMES),
    9: ("--x", "--y", "--z", "--qx", "--qy", "--qz", "--qw", *_FRAMES),
}
"""By the number of arguments without names."""
_WIDTH = 99
"""The characters of a line that ament_flake8 allows."""


class StaticTransformArguments(Rule):
    """A launch file gives ``static_transform_publisher`` arguments without names.

    **Why.** The program ends at once: Lyrical does not understand them any more.

    **Fix.** Put the name before each value; all distributions know the names.

    **Source.** geometry2, ``static_transform_broadcaster_program.cpp``.
    """

    code = "LF080"
    name = "static-transform-arguments"
    is_fixed_for_all = True
    examples = (
        Example("still known", {"launch/a.launch.py": _LAUNCH.format(_OLD)}),
        Example("names", {"launch/a.launch.py": _LAUNCH.format(_NEW)}, distro="lyrical"),
        Example(
            "no names",
            {
                "launch/a.launch.py": _LAUNCH.format(_OLD),
                "launch/b.launch.xml": _XML.format("1 0 0 0 0 0 base laser"),
            },
            Report(
                "launch/a.launch.py:8:24",
                "static_transform_publisher of Lyrical takes no arguments "
                "without names; write --x, --y and so on",
                fix="write the names",
            ),
            Report(
                "launch/b.launch.xml:2:63",
                "static_transform_publisher of Lyrical takes no arguments "
                "without names; write --x, --y and so on",
                fix="write the names",
            ),
            fixed={
                "launch/a.launch.py": _LAUNCH.format(_LINES),
                "launch/b.launch.xml": _XML.format(_NEW.replace("'", "").replace(",", "")),
            },
            distro="lyrical",
        ),
        Example(
            "a list with room",
            {"launch/a.launch.py": _LAUNCH.format(_ROOMY.format(*[""] * 8))},
            Report(
                "8:24",
                "static_transform_publisher of Lyrical takes no arguments without "
                "names; write --x, --y and so on",
                fix="write the names",
            ),
            fixed={
                "launch/a.launch.py": _LAUNCH.format(
                    _ROOMY.format(*[f"'{flag}', " for flag in _FLAGS[8]])
                )
            },
            distro="lyrical",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        (change,) = of_kind("launch")
        if not change.is_removed:
            return
        message = (
            f"{change.names[0]} of {target().title} takes no arguments without names; "
            f"{change.advice}"
        )
        for launch in LaunchFile.of_package(package):
            for location, edits in _written_in_python(launch, change.names[0]):
                yield self.report(location, message, Fix("write the names", edits))
        for file in markup_files(package):
            for node in file.nodes:
                given = node.arguments
                if node.executable is None or node.executable.value not in change.names:
                    continue
                words = given.value.split() if given is not None else []
                flags = _FLAGS.get(len(words))
                if given is None or flags is None or any(item.startswith("--") for item in words):
                    continue
                edit = _edit(package, given.location, given.value, _named(words, flags))
                fix = Fix("write the names", (edit,)) if edit is not None else None
                yield self.report(given.location, message, fix)


def _written_in_python(
    launch: LaunchFile, name: str
) -> Iterator[tuple[Location, tuple[Edit, ...]]]:
    for call in launch.find(*NODES):
        executable, given = call.given.get("executable"), call.given.get("arguments")
        match executable, given:
            case ast.Constant(value=written), ast.List(elts=values) if written == name:
                flags = _FLAGS.get(len(values))
                if flags is not None and not any(map(_is_flag, values)):
                    yield launch.location(given), tuple(_edits(launch, given, flags))


def _named(words: Sequence[str], flags: Sequence[str]) -> str:
    return " ".join(f"{flag} {word}" for flag, word in zip(flags, words, strict=True))


def _edit(package: Package, at: Location, old: str, new: str) -> Edit | None:
    """Replace the value of an attribute, where it is written as it is read."""
    lines = package.source(at.path).text.split("\n")
    start = sum(len(line) + 1 for line in lines[: at.line - 1]) + at.column - 1
    is_plain = lines[at.line - 1].startswith(old, at.column - 1)
    return Edit(at.path, start, start + len(old), new) if is_plain else None


def _is_flag(node: ast.expr) -> bool:
    return isinstance(node, ast.Constant) and str(node.value).startswith("--")


def _edits(launch: LaunchFile, given: ast.List, flags: tuple[str, ...]) -> Iterator[Edit]:
    """Put the names before the values; in a list that gets too wide, each pair on a line."""
    text = launch.module.source.text
    start, end = launch.module.span(given)
    spans = [launch.module.span(value) for value in given.elts]
    added = [
        Edit(launch.path, place, place, f"'{flag}', ")
        for (place, _), flag in zip(spans, flags, strict=True)
    ]
    above = text.rfind("\n", 0, start) + 1
    below = text.find("\n", end)
    parts = [text[above : spans[0][0]]]
    for (first, _), (after, _), flag in zip(
        spans, [*spans[1:], (below, below)], flags, strict=True
    ):
        parts.append(f"'{flag}', {text[first:after]}")
    if max(map(len, "".join(parts).split("\n"))) <= _WIDTH or "#" in text[start:end]:
        yield from added
        return
    line = text[above:start]
    indent = line[: len(line) - len(line.lstrip())]
    pairs = [
        f"{indent}    '{flag}', {text[first:last]},\n"
        for (first, last), flag in zip(spans, flags, strict=True)
    ]
    yield Edit(launch.path, start, end, f"[\n{''.join(pairs)}{indent}]")
