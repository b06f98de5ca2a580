"""LF067: static_transform_publisher gets valid options and values."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise

from scaffold.api import Diagnostic, Example, Location, Package, Rule, closest_name
from scaffold.api.distributions import of_program
from scaffold.api.launch import PROGRAM, UNSAID, Word, static_transforms

_LAUNCH = (
    "from launch import LaunchDescription\nfrom launch_ros.actions import Node\n\n\n"
    "def generate_launch_description():\n    return LaunchDescription([\n"
    "        Node(package='tf2_ros', executable='static_transform_publisher',\n"
    "             arguments=[{}]),\n    ])\n"
)
_XML = '<launch>\n  <node pkg="tf2_ros" exec="static_transform_publisher" args="{}"/>\n</launch>\n'
_VALUES = ("--x", "--y", "--z", "--qx", "--qy", "--qz", "--qw", "--roll", "--pitch", "--yaw")
_FRAMES = ("--frame-id", "--child-frame-id")
_POSITIONAL = (8, 9)
_TURN = 6.3
"""Radians, slightly more than a full turn."""


class StaticTransformMisused(Rule):
    """A launch file passes invalid or incomplete options to static_transform_publisher.

    Also reported are angles in degrees, and values that are not numbers, such as in ROS 1
    arguments, which end with a period.

    **Why.** It exits at once with ``must specify --frame-id``: the frame is missing, and nodes wait
    for a transform that never arrives. Angles are in radians: a rotation by 90 radians points in an
    arbitrary direction.

    **Fix.** Pass ``--x 0.1 --yaw 1.57 --frame-id base_link --child-frame-id laser``, each value as
    a separate string.

    **Source.** tf2_ros, ``static_transform_broadcaster_program.cpp``.
    """

    code = "LF067"
    name = "static-transform-misused"
    examples = (
        Example(
            "options; positional arguments; an unknown value",
            {
                "launch/a.launch.py": _LAUNCH.format(
                    "'--x', '0.1', '--frame-id', 'a', '--child-frame-id', 'b'"
                ),
                "launch/b.launch.py": _LAUNCH.format("*'0 0 0 0 0 0 a b'.split()"),
                "launch/c.launch.xml": _XML.format("0 0 0 0 0 0 a b"),
            },
        ),
        Example(
            "a misspelled option; a missing option",
            {
                "launch/a.launch.py": _LAUNCH.format("'--frame_id', 'a', '--child-frame-id', 'b'"),
                "launch/b.launch.py": _LAUNCH.format("'--x', '1', '--frame-id', 'a'"),
                "launch/c.launch.xml": _XML.format("--tx 1 --frame-id a --child-frame-id b"),
            },
            "launch/a.launch.py:8:25: unknown option '--frame_id': static_transform_publisher "
            "exits at once; did you mean '--frame-id'?",
            "launch/b.launch.py:7:9: missing '--child-frame-id': static_transform_publisher exits "
            "at once",
            "launch/c.launch.xml:2:63: unknown option '--tx': static_transform_publisher exits at "
            "once; did you mean '--x'?",
        ),
        Example(
            "options that Lyrical ignores",
            {
                "launch/a.launch.py": _LAUNCH.format(
                    "'--tx', '1', '--frame-id', 'a', '--child-frame-id', 'b'"
                ),
                "launch/b.launch.py": _LAUNCH.format(
                    "'0.1', '--frame-id', 'a', '--child-frame-id', 'b'"
                ),
            },
            "launch/a.launch.py:8:25: unknown option '--tx': static_transform_publisher ignores "
            "it; did you mean '--x'?",
            "launch/b.launch.py:8:25: '0.1' has no option before it: static_transform_publisher "
            "ignores it",
            distro="lyrical",
        ),
        Example(
            "a process, and unknown values",
            {
                "launch/a.launch.xml": "<launch>\n  <executable cmd='ros2 run tf2_ros "
                "static_transform_publisher --x 1 --frame-id a'/>\n</launch>\n",
                "launch/b.launch.xml": _XML.format("$(var x) --frame-id a"),
                "launch/c.launch.xml": _XML.format("--frame-id a --child-frame-id $(var b c)"),
                "launch/d.launch.xml": _XML.format("0 0 0 $(var rotation) a b"),
            },
            "launch/a.launch.xml:2:20: missing '--child-frame-id': static_transform_publisher "
            "exits at once",
        ),
        Example(
            "degrees",
            {
                "launch/a.launch.py": _LAUNCH.format(
                    "'--yaw', '90', '--frame-id', 'a', '--child-frame-id', 'b'"
                ),
                "launch/b.launch.xml": _XML.format("7 8 9 -6.28 0 180 a b"),
                "launch/c.launch.xml": _XML.format("7 8 9 10 11 12 13 a b"),
            },
            "launch/a.launch.py:8:34: angles are in radians: 90 is more than a turn",
            "launch/b.launch.xml:2:63: angles are in radians: 180 is more than a turn",
        ),
        Example(
            "ROS 1 arguments, with a period at the end; a value that is not a number",
            {
                "launch/a.launch.py": _LAUNCH.format("*'0 0 0 0 0 0 a b 100'.split()"),
                "launch/b.launch.py": _LAUNCH.format(
                    "'--yaw', 'pi', '--frame-id', 'a', '--child-frame-id', 'b'"
                ),
                "launch/c.launch.xml": _XML.format("1e-1 .5 -.5 +0 inf 1.0f 1 a b"),
            },
            "launch/a.launch.py:8:26: 'a' is not a number: static_transform_publisher exits at "
            "once",
            "launch/b.launch.py:8:34: 'pi' is not a number: static_transform_publisher exits at "
            "once",
        ),
        Example(
            "a value without an option",
            {
                "launch/a.launch.py": _LAUNCH.format(
                    "'0.1', '--frame-id', 'a', '--child-frame-id', 'b'"
                )
            },
            "8:25: '0.1' has no option before it: static_transform_publisher exits at once",
        ),
        Example(
            "too few numbers; two kinds of rotation; one frame",
            {
                "launch/a.launch.py": _LAUNCH.format("'0', '0', '0', 'a', 'b'"),
                "launch/b.launch.py": _LAUNCH.format(
                    "'--yaw', '1', '--qw', '1', '--frame-id', 'a', '--child-frame-id', 'b'"
                ),
                "launch/c.launch.xml": _XML.format("--frame-id a --child-frame-id a"),
            },
            "launch/a.launch.py:7:9: 5 positional arguments: static_transform_publisher exits at "
            "once; write --frame-id, --child-frame-id and --x, --y, ...",
            "launch/b.launch.py:7:9: both angles and a quaternion: static_transform_publisher "
            "exits at once; pass one of them",
            "launch/c.launch.xml:2:63: 'a' is its own parent: tf2 ignores the transform",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for transform in static_transforms(package):
            for angle in _angle_words(transform.words):
                if _is_beyond_a_turn(angle.text):
                    message = f"angles are in radians: {angle.text} is more than a turn"
                    yield self.report(angle.location, message)
            whole = transform.given if transform.attribute is not None else transform.location
            options = [n for n, word in enumerate(transform.words) if word.text.startswith("--")]
            for word in _invalid_numbers(transform.words):
                message = f"{word.text!r} is not a number: {PROGRAM} exits at once"
                yield self.report(word.location, message)
            if options:
                yield from self._check_options(package, transform.words, options, whole)
                continue
            count = len(transform.words)
            if count not in _POSITIONAL and all(word.text != UNSAID for word in transform.words):
                message = (
                    f"{count} positional arguments: {PROGRAM} exits at once; write --frame-id, "
                    f"--child-frame-id and --x, --y, ..."
                )
                yield self.report(whole, message)

    def _check_options(
        self, package: Package, words: Sequence[Word], options: Sequence[int], whole: Location
    ) -> Iterator[Diagnostic]:
        texts = [word.text for word in words]
        loose = [n for n in range(len(words)) if n not in options and n - 1 not in options]
        if any(texts[index] == UNSAID for index in loose):
            return  # which may be an option
        change = of_program(PROGRAM)
        then = "ignores it" if change.is_removed else "exits at once"
        unknown = [index for index in options if texts[index] not in (*_VALUES, *_FRAMES, "--help")]
        for index in unknown:
            closest = closest_name(package, texts[index], (*_VALUES, *_FRAMES), 0.6)
            hint = f"; did you mean {closest!r}?" if closest else ""
            message = f"unknown option {texts[index]!r}: {PROGRAM} {then}{hint}"
            yield self.report(words[index].location, message)
        for index in loose if not unknown else ():
            message = f"{texts[index]!r} has no option before it: {PROGRAM} {then}"
            yield self.report(words[index].location, message)
        for frame in _FRAMES:
            if frame not in texts and not unknown:
                yield self.report(whole, f"missing {frame!r}: {PROGRAM} exits at once")
        given = {texts[index] for index in options}
        if given & {"--roll", "--pitch", "--yaw"} and given & {"--qx", "--qy", "--qz", "--qw"}:
            message = f"both angles and a quaternion: {PROGRAM} exits at once; pass one of them"
            yield self.report(whole, message)
        frames = [texts[texts.index(frame) + 1 :][:1] for frame in _FRAMES if frame in texts]
        if len(frames) == len(_FRAMES) and frames[0] == frames[1] != [UNSAID]:
            message = f"{frames[0][0]!r} is its own parent: tf2 ignores the transform"
            yield self.report(whole, message)


def _invalid_numbers(words: Sequence[Word]) -> Iterator[Word]:
    """Yield the words that should be numbers but are not."""
    if of_program(PROGRAM).is_removed:
        return  # positional arguments are rejected anyway
    values = [value for option, value in pairwise(words) if option.text in _VALUES]
    if len(words) in _POSITIONAL and not any(word.text.startswith("--") for word in words):
        values = list(words[: -len(_FRAMES)])
    yield from (value for value in values if value.is_no_number)


def _angle_words(words: Sequence[Word]) -> Sequence[Word]:
    """Return the words that are angles."""
    if len(words) == _POSITIONAL[0] and not any(word.text.startswith("--") for word in words):
        return words[3:6]
    return [
        value for option, value in pairwise(words) if option.text in {"--roll", "--pitch", "--yaw"}
    ]


def _is_beyond_a_turn(text: str) -> bool:
    try:
        return abs(float(text)) > _TURN
    except ValueError:
        return False
