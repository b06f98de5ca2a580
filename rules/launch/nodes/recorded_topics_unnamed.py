"""LF082: topics to record are passed with --topics."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from scaffold.api import Diagnostic, Edit, Example, Fix, Package, Report, Rule
from scaffold.api.distributions import of_program, target
from scaffold.api.launch import UNSAID, CommandLine, Word, processes, start_of_value

_PROGRAM = "ros2 bag record"
_FLAGS = frozenset(
    {"-a", "--all", "--all-topics", "--all-services", "--all-actions", "--no-discovery"}
    | {"--include-unpublished-topics", "--include-hidden-topics", "--ignore-leaf-topics"}
    | {"--disable-keyboard-controls", "--start-paused", "--use-sim-time", "--snapshot-mode"}
)
_WITH_VALUE = frozenset(
    {"-o", "--output", "-s", "--storage", "-e", "--regex", "--exclude-regex", "-p"}
    | {"--polling-interval", "--qos-profile-overrides-path", "-f", "--serialization-format"}
    | {"-b", "--max-bag-size", "-d", "--max-bag-duration", "--max-cache-size", "--node-name"}
    | {"--log-level", "--compression-queue-size", "--compression-threads", "--compression-mode"}
    | {"--compression-threads-priority", "--compression-format", "--storage-config-file"}
    | {"--storage-preset-profile"}
)
_WITH_VALUES = frozenset(
    {"--topics", "--services", "--actions", "--topic-types", "--exclude-topic-types"}
    | {"--exclude-topics", "--exclude-services", "--exclude-actions", "--custom-data"}
)
_LAUNCH = (
    "from launch import LaunchDescription\nfrom launch.actions import ExecuteProcess\n\n\n"
    "def generate_launch_description():\n    return LaunchDescription([\n"
    "        ExecuteProcess(cmd=['ros2', 'bag', 'record', {}]),\n    ])\n"
)
_FOUND = (
    "from launch.actions import ExecuteProcess\nfrom launch.substitutions import FindExecutable\n"
    "\nROS = FindExecutable(name='ros2')\n"
    "RECORDER = ExecuteProcess(cmd={})\n"
)
_XML = "<launch>\n  <executable cmd='ros2 bag record {}'/>\n</launch>\n"


class RecordedTopicsUnnamed(Rule):
    """A launch file passes topics to ``ros2 bag record`` without ``--topics``.

    **Why.** Lyrical no longer accepts positional topics: the recorder exits at once with
    ``unrecognized arguments``, and nothing is recorded.

    **Fix.** Write ``--topics`` before them, which works since Jazzy.

    **Source.** rosbag2 issue 2328.
    """

    code = "LF082"
    name = "recorded-topics-unnamed"
    is_fixed_for_all = True
    since = "0.2"
    examples = (
        Example(
            "a distribution that still accepts them",
            {"launch/a.launch.py": _LAUNCH.format("'/scan'")},
        ),
        Example(
            "options with values, all topics, and unknown values",
            {
                "launch/a.launch.py": _LAUNCH.format("'-o', name(), '--topics', '/scan', '/tf'"),
                "launch/b.launch.py": _LAUNCH.format("'-a', '-s', 'mcap', '--node-name=bag'"),
                "launch/c.launch.py": _LAUNCH.format("flag(), 'bag', '--quick', 'yes'"),
                "launch/d.launch.xml": _XML.format("-e '/cam.*' --output $(var bag)"),
            },
            distro="lyrical",
        ),
        Example(
            "topics without the option",
            {
                "launch/a.launch.py": _LAUNCH.format("'/scan', '/tf', '-o', 'bag'"),
                "launch/b.launch.xml": _XML.format("-s mcap /scan /tf"),
            },
            Report(
                "launch/a.launch.py:7:54",
                "'/scan' is a positional argument: ros2 bag record of Lyrical exits at "
                "once; use --topics (rosbag2 2328)",
                fix="Replace with --topics",
            ),
            Report(
                "launch/b.launch.xml:2:20",
                "'/scan' is a positional argument: ros2 bag record of Lyrical exits at "
                "once; use --topics (rosbag2 2328)",
                fix="Replace with --topics",
            ),
            fixed={
                "launch/a.launch.py": _LAUNCH.format("'--topics', '/scan', '/tf', '-o', 'bag'"),
                "launch/b.launch.xml": _XML.format("-s mcap --topics /scan /tf"),
            },
            distro="lyrical",
        ),
        Example(
            "a program that launch finds",
            {
                "launch/a.launch.py": _FOUND.format("[ROS, 'bag', 'record', '/tf']"),
                "launch/c.launch.xml": _XML.format("/tf").replace("ros2", "$(find-exec ros2)"),
            },
            Report(
                "launch/a.launch.py:5:54",
                "'/tf' is a positional argument: ros2 bag record of Lyrical exits at "
                "once; use --topics (rosbag2 2328)",
                fix="Replace with --topics",
            ),
            Report(
                "launch/c.launch.xml:2:20",
                "'/tf' is a positional argument: ros2 bag record of Lyrical exits at "
                "once; use --topics (rosbag2 2328)",
                fix="Replace with --topics",
            ),
            fixed={
                "launch/a.launch.py": _FOUND.format("[ROS, 'bag', 'record', '--topics', '/tf']"),
                "launch/c.launch.xml": _XML.format("--topics /tf").replace(
                    "ros2", "$(find-exec ros2)"
                ),
            },
            distro="lyrical",
        ),
        Example(
            "in quotes",
            {
                "launch/a.launch.yaml": 'launch:\n- executable:\n    cmd: "ros2 bag record /tf"\n',
                "launch/b.launch.yaml": "launch:\n- executable:\n    cmd: 'ros2 bag record /tf'\n",
            },
            Report(
                "launch/a.launch.yaml:3:10",
                "'/tf' is a positional argument: ros2 bag record of Lyrical exits at "
                "once; use --topics (rosbag2 2328)",
                fix="Replace with --topics",
            ),
            Report(
                "launch/b.launch.yaml:3:10",
                "'/tf' is a positional argument: ros2 bag record of Lyrical exits at "
                "once; use --topics (rosbag2 2328)",
                fix="Replace with --topics",
            ),
            fixed={
                "launch/a.launch.yaml": "launch:\n- executable:\n"
                '    cmd: "ros2 bag record --topics /tf"\n',
                "launch/b.launch.yaml": "launch:\n- executable:\n"
                "    cmd: 'ros2 bag record --topics /tf'\n",
            },
            distro="lyrical",
        ),
        Example(
            "in quotes with escapes",
            {
                "launch/c.launch.yaml": "launch:\n- executable:\n"
                '    cmd: "ros2 bag record \\x2Ftf"\n',
            },
            "3:10: '/tf' is a positional argument: ros2 bag record of Lyrical exits at once; use "
            "--topics (rosbag2 2328)",
            distro="lyrical",
        ),
        Example(
            "topics in a variable",
            {
                "launch/a.launch.py": _LAUNCH.format("'-o', name(), *'/scan /tf'.split()"),
                "launch/b.launch.py": _FOUND.format("[[ROS, ' bag record ', '/tf']], shell=True"),
            },
            "launch/a.launch.py:7:69: '/scan' is a positional argument: ros2 bag record of "
            "Lyrical exits at once; use --topics (rosbag2 2328)",
            "launch/b.launch.py:5:32: '/tf' is a positional argument: ros2 bag record of Lyrical "
            "exits at once; use --topics (rosbag2 2328)",
            distro="lyrical",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        change = of_program(_PROGRAM)
        if not change.is_removed:
            return
        for line in processes(package):
            if " ".join(word.text for word in line.words[:3]) != _PROGRAM:
                continue
            topics = _unnamed(line.words[3:])
            if topics:
                message = (
                    f"{topics[0].text!r} is a positional argument: {_PROGRAM} of {target().title} "
                    f"exits at once; {change.instead(change.use)} ({change.source})"
                )
                edit = _edit(package, line, topics[0]) if change.has_replacement else None
                fix = Fix(f"Replace with {change.use}", (edit,)) if edit is not None else None
                yield self.report(topics[0].location, message, fix)


def _unnamed(words: Sequence[Word]) -> list[Word]:
    """Return the positional words; empty if an option is unknown."""
    result: list[Word] = []
    takes: float = 0
    for word in words:
        name, equals, _ = word.text.partition("=")
        if word.text.startswith("-"):
            if name not in _FLAGS | _WITH_VALUE | _WITH_VALUES:
                return []
            takes = float("inf") if name in _WITH_VALUES else name in _WITH_VALUE and not equals
        elif takes:
            takes -= 1
        elif word.text == UNSAID and not result:
            return []
        else:
            result.append(word)
    return result


def _edit(package: Package, line: CommandLine, topic: Word) -> Edit | None:
    """Return the edit that adds the option before a topic, if it is a literal."""
    if line.launch is not None and topic.node is not None:
        module = line.launch.module
        is_alone = sum(word.node is topic.node for word in line.words) == 1
        if is_alone and line.expression in [*module.parents(topic.node)]:
            start, _ = module.span(topic.node)
            return Edit(line.launch.path, start, start, "'--topics', ")
    if line.attribute is not None and topic.span is not None:
        path = line.attribute.location.path
        value_start = start_of_value(package.source(path), line.attribute)
        if value_start is not None:
            place = value_start + topic.span[0]
            return Edit(path, place, place, "--topics ")
    return None
