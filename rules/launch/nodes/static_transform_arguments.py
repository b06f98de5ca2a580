"""LF080: static_transform_publisher gets named arguments."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Sequence
from itertools import groupby

from scaffold.api import Diagnostic, Edit, Example, Fix, Package, Report, Rule
from scaffold.api.distributions import of_program, target
from scaffold.api.launch import (
    PROGRAM,
    Attribute,
    CommandLine,
    LaunchFile,
    Word,
    start_of_value,
    static_transforms,
)

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
_PROGRAMS = (
    "from launch import LaunchDescription\nfrom launch.actions import ExecuteProcess\n"
    "from launch_ros.actions import Node\n\n\n"
    "def generate_launch_description():\n"
    "    words = ['0', '0', '0', '0', '0', '0']\n"
    "    node = 'static_transform_publisher'\n"
    "    return LaunchDescription([\n"
    "        Node(package='tf2_ros', executable=node,\n"
    "             arguments='0 0 0 0 0 0 base laser'.split()),\n"
    "        Node(package='tf2_ros', executable=node, arguments=words + ['base', 'laser']),\n"
    "        Node(package='tf2_ros', executable=node, arguments=[\n"
    "            '0', '0', '0', '0', '0', '0', '1', 'a', 'b', '--ros-args', '-r', 'a:=b']),\n"
    "        ExecuteProcess(cmd=['ros2', 'run', 'tf2_ros', node, *'0 0 0 0 0 0 a b'.split()]),\n"
    "    ])\n"
)
_PROCESS = (
    "<launch>\n  <executable cmd='ros2 run tf2_ros static_transform_publisher {}1 {}0 {}0 {}0 {}0 "
    "{}0 {}$(var base frame) {}laser --ros-args -r a:=b'/>\n</launch>\n"
)
_FRAMES = ("--frame-id", "--child-frame-id")
_FLAGS = {
    8: ("--x", "--y", "--z", "--yaw", "--pitch", "--roll", *_FRAMES),
    9: ("--x", "--y", "--z", "--qx", "--qy", "--qz", "--qw", *_FRAMES),
}
"""The flags, by the number of positional arguments."""
_WIDTH = 99
"""The maximum line length of ament_flake8."""


class StaticTransformArguments(Rule):
    """A launch file passes positional arguments to ``static_transform_publisher``.

    **Why.** Lyrical no longer accepts them: the program exits at once.

    **Fix.** Write the option before each value, such as ``--x 1``; this works on all distributions.

    **Source.** geometry2, ``static_transform_broadcaster_program.cpp``.
    """

    code = "LF080"
    name = "static-transform-arguments"
    is_fixed_for_all = True
    examples = (
        Example(
            "a distribution that still accepts them", {"launch/a.launch.py": _LAUNCH.format(_OLD)}
        ),
        Example("named arguments", {"launch/a.launch.py": _LAUNCH.format(_NEW)}, distro="lyrical"),
        Example(
            "positional arguments",
            {
                "launch/a.launch.py": _LAUNCH.format(_OLD),
                "launch/b.launch.xml": _XML.format("1 0 0 0 0 0 base laser"),
            },
            Report(
                "launch/a.launch.py:8:24",
                "static_transform_publisher of Lyrical takes no positional arguments; "
                "write --x, --y and so on",
                fix="Use named arguments",
            ),
            Report(
                "launch/b.launch.xml:2:63",
                "static_transform_publisher of Lyrical takes no positional arguments; "
                "write --x, --y and so on",
                fix="Use named arguments",
            ),
            fixed={
                "launch/a.launch.py": _LAUNCH.format(_LINES),
                "launch/b.launch.xml": _XML.format(_NEW.replace("'", "").replace(",", "")),
            },
            distro="lyrical",
        ),
        Example(
            "a list over several lines",
            {"launch/a.launch.py": _LAUNCH.format(_ROOMY.format(*[""] * 8))},
            Report(
                "8:24",
                "static_transform_publisher of Lyrical takes no positional arguments; "
                "write --x, --y and so on",
                fix="Use named arguments",
            ),
            fixed={
                "launch/a.launch.py": _LAUNCH.format(
                    _ROOMY.format(*[f"'{flag}', " for flag in _FLAGS[8]])
                )
            },
            distro="lyrical",
        ),
        Example(
            "other forms of arguments",
            {
                "launch/a.launch.py": _PROGRAMS,
                "launch/b.launch.xml": _PROCESS.format(*[""] * 8),
            },
            Report(
                "launch/a.launch.py:11:24",
                "static_transform_publisher of Lyrical takes no positional arguments; "
                "write --x, --y and so on",
                fix="Use named arguments",
            ),
            Report(
                "launch/a.launch.py:12:60",
                "static_transform_publisher of Lyrical takes no positional arguments; "
                "write --x, --y and so on",
                fix="Use named arguments",
            ),
            Report(
                "launch/a.launch.py:13:60",
                "static_transform_publisher of Lyrical takes no positional arguments; "
                "write --x, --y and so on",
                fix="Use named arguments",
            ),
            Report(
                "launch/a.launch.py:15:28",
                "static_transform_publisher of Lyrical takes no positional arguments; "
                "write --x, --y and so on",
                fix="Use named arguments",
            ),
            Report(
                "launch/b.launch.xml:2:20",
                "static_transform_publisher of Lyrical takes no positional arguments; "
                "write --x, --y and so on",
                fix="Use named arguments",
            ),
            fixed={
                "launch/a.launch.py": _PROGRAMS.replace(
                    "['0', '0', '0', '0', '0', '0']",
                    "['--x', '0', '--y', '0', '--z', '0', '--yaw', '0', '--pitch', '0', "
                    "'--roll', '0']",
                )
                .replace(
                    "'0 0 0 0 0 0 base laser'",
                    "('--x 0 --y 0 --z 0 --yaw 0 --pitch 0 --roll 0 '\n"
                    f"{' ' * 24}'--frame-id base --child-frame-id laser')",
                )
                .replace(
                    "words + ['base', 'laser']",
                    "words + [\n            '--frame-id', 'base',\n"
                    "            '--child-frame-id', 'laser',\n        ]",
                )
                .replace(
                    "\n            '0', '0', '0', '0', '0', '0', '1', 'a', 'b', "
                    "'--ros-args', '-r', 'a:=b'",
                    "\n            '--x', '0',\n            '--y', '0',\n            '--z', '0',"
                    "\n            '--qx', '0',\n            '--qy', '0',\n            '--qz', '0',"
                    "\n            '--qw', '1',\n            '--frame-id', 'a',"
                    "\n            '--child-frame-id', 'b',"
                    "\n            '--ros-args', '-r', 'a:=b',\n        ",
                )
                .replace(
                    "*'0 0 0 0 0 0 a b'",
                    "*('--x 0 --y 0 --z 0 --yaw 0 --pitch 0 --roll 0 '\n"
                    f"{' ' * 62}'--frame-id a --child-frame-id b')",
                ),
                "launch/b.launch.xml": _PROCESS.format(*[f"{flag} " for flag in _FLAGS[8]]),
            },
            distro="lyrical",
        ),
        Example(
            "a list for two programs",
            {
                "launch/a.launch.py": "from launch_ros.actions import Node\n\n"
                "NODE = 'static_transform_publisher'\n"
                "WORDS = ['0', '0', '0', '0', '0', '0', 'base', 'laser']\n\n\n"
                "def nodes():\n"
                "    yield Node(package='tf2_ros', executable=NODE, arguments=WORDS)\n"
                "    yield Node(package='tf2_ros', executable=NODE,\n"
                "               arguments=[*WORDS, '--ros-args', '-r', 'a:=b'])\n"
            },
            "8:62: static_transform_publisher of Lyrical takes no positional arguments; write "
            "--x, --y and so on",
            "10:26: static_transform_publisher of Lyrical takes no positional arguments; write "
            "--x, --y and so on",
            distro="lyrical",
        ),
        Example(
            "the arguments of ROS 1, with a period at the end",
            {"launch/a.launch.xml": _XML.format("0 0 0 0 0 0 base laser 100")},
            "2:63: static_transform_publisher of Lyrical takes no positional arguments; write "
            "--x, --y and so on",
            distro="lyrical",
        ),
        Example(
            "incomplete arguments, and other programs",
            {
                "launch/a.launch.py": _LAUNCH.format("*more(), '0', 'a', 'b'"),
                "launch/b.launch.xml": _PROCESS.format(*[""] * 8).replace("tf2_ros static", "a b"),
            },
            distro="lyrical",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        change = of_program(PROGRAM)
        if not change.is_removed:
            return
        message = f"{PROGRAM} of {target().title} takes no positional arguments; {change.advice}"
        for transform in static_transforms(package):
            words = transform.words
            flags = _FLAGS.get(len(words))
            if flags is None or any(word.text.startswith("--") for word in words):
                continue
            edits: tuple[Edit, ...] = ()
            if any(word.is_no_number for word in words[: -len(_FRAMES)]):
                pass  # arguments in another order, as in ROS 1
            elif transform.attribute is not None:
                edits = _in_markup(package, transform.attribute, words, flags)
            else:
                edits = _in_python(transform, flags)
            fix = Fix("Use named arguments", edits) if edits else None
            yield self.report(transform.given, message, fix)


def _in_markup(
    package: Package, attribute: Attribute, words: Sequence[Word], flags: Sequence[str]
) -> tuple[Edit, ...]:
    """Add the flags to the value of an attribute, if it contains no references."""
    path = attribute.location.path
    start = start_of_value(package.source(path), attribute)
    if start is None:
        return ()
    return tuple(
        Edit(path, start + word.span[0], start + word.span[0], f"{flag} ")
        for word, flag in zip(words, flags, strict=True)
        if word.span is not None
    )


def _in_python(transform: CommandLine, flags: Sequence[str]) -> tuple[Edit, ...]:
    launch, nodes = transform.launch, [word.node for word in transform.words]
    values = [node for node in nodes if node is not None]
    if launch is None or len(values) < len(flags):
        return ()
    if len({*values}) == 1:
        return _in_text(launch, values[0], flags)
    if len({*values}) < len(values) or not all(
        _is_for_this_alone(launch, transform.expression, value) for value in values
    ):
        return ()
    return tuple(
        edit
        for holder, pairs in groupby(
            zip(values, flags, strict=True), key=lambda pair: launch.module.parent(pair[0])
        )
        for edit in _in_holder(launch, holder, [*pairs])
    )


def _is_for_this_alone(launch: LaunchFile, expression: ast.expr | None, value: ast.expr) -> bool:
    """Return whether nothing else uses the list of a value."""
    names = [node for node in ast.walk(expression or value) if isinstance(node, ast.Name)]
    around = [value, *launch.module.parents(value)]
    if expression not in around:
        statement = next(node for node in around if isinstance(node, ast.stmt))
        targets = statement.targets if isinstance(statement, ast.Assign) else []
        if not targets or not all(isinstance(item, ast.Name) for item in targets):
            return False
        names += [item for item in targets if isinstance(item, ast.Name)]
    elif isinstance(expression, ast.List):
        return True
    return all(
        sum(isinstance(use.ctx, ast.Load) for use in launch.module.index.names(name.id)) == 1
        for name in names
    )


def _in_text(launch: LaunchFile, node: ast.expr, flags: Sequence[str]) -> tuple[Edit, ...]:
    """Add the flags to the text of ``'...'.split()``, over several lines."""
    match node:
        case ast.Call(
            func=ast.Attribute(value=ast.Constant(value=str(text)) as written, attr="split"),
            args=[],
            keywords=[],
        ):
            words = text.split()
            start, end = launch.module.span(written)
            if len(words) == len(flags) and launch.module.source.text[start + 1 : end - 1] == text:
                pairs = [f"{flag} {word}" for flag, word in zip(flags, words, strict=True)]
                indent = " " * (launch.location(written).column)
                values, frames = " ".join(pairs[:-2]), " ".join(pairs[-2:])
                new = f"('{values} '\n{indent}'{frames}')"
                return (Edit(launch.path, start, end, new),)
    return ()


def _in_holder(
    launch: LaunchFile, holder: ast.AST | None, pairs: Sequence[tuple[ast.expr, str]]
) -> Iterator[Edit]:
    """Add the flags before the values; in a long list, one pair per line."""
    module, text = launch.module, launch.module.source.text
    spans = [module.span(value) for value, _ in pairs]
    added = [
        Edit(launch.path, start, start, f"'{flag}', ")
        for (start, _), (_, flag) in zip(spans, pairs, strict=True)
    ]
    if not isinstance(holder, ast.List):
        yield from added
        return
    start, end = module.span(holder)
    above, below = text.rfind("\n", 0, start) + 1, text.find("\n", end)
    wide = text[above:below]
    for edit in reversed(added):
        wide = wide[: edit.start - above] + edit.text + wide[edit.start - above :]
    if max(map(len, wide.split("\n"))) <= _WIDTH or "#" in text[start:end]:
        yield from added
        return
    line = text[above:start]
    indent = line[: len(line) - len(line.lstrip())]
    lines = [
        text[start + 1 : spans[0][0]].strip().rstrip(","),
        *(f"'{flag}', {text[slice(*span)]}" for span, (_, flag) in zip(spans, pairs, strict=True)),
        text[spans[-1][1] : end - 1].strip(", \n"),
    ]
    body = "".join(f"{indent}    {line},\n" for line in lines if line)
    yield Edit(launch.path, start, end, f"[\n{body}{indent}]")
