"""LF067: static_transform_publisher gets options that it knows."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from scaffold.api import Diagnostic, Example, Location, Package, Report, Rule, closest_name
from scaffold.api.launch import LaunchFile, markup_files

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
_PROGRAM = "static_transform_publisher"


class StaticTransformMisused(Rule):
    """A launch file gives static_transform_publisher options that it does not know, or too few.

    **Why.** It ends at once, ``must specify --frame-id``: the frame is missing, and nodes wait for
    a transform that never comes.

    **Fix.** ``--x 0.1 --yaw 1.57 --frame-id base_link --child-frame-id laser``, each value in a
    string of its own.

    **Source.** tf2_ros, ``static_transform_broadcaster_program.cpp``.
    """

    code = "LF067"
    name = "static-transform-misused"
    examples = (
        Example(
            "options; the old way; unknown",
            {
                "launch/a.launch.py": _LAUNCH.format(
                    "'--x', '0.1', '--frame-id', 'a', '--child-frame-id', 'b'"
                ),
                "launch/b.launch.py": _LAUNCH.format("*'0 0 0 0 0 0 a b'.split()"),
                "launch/c.launch.xml": _XML.format("0 0 0 0 0 0 a b"),
            },
        ),
        Example(
            "an option misspelt; none of another",
            {
                "launch/a.launch.py": _LAUNCH.format("'--frame_id', 'a', '--child-frame-id', 'b'"),
                "launch/b.launch.py": _LAUNCH.format("'--x', '1', '--frame-id', 'a'"),
                "launch/c.launch.xml": _XML.format("--tx 1 --frame-id a --child-frame-id b"),
            },
            Report(
                "launch/a.launch.py:8:25",
                "static_transform_publisher has no option '--frame_id': it ends at "
                "once; closest: '--frame-id'",
            ),
            Report(
                "launch/b.launch.py:7:9",
                "no '--child-frame-id': static_transform_publisher ends at once, it must be given",
            ),
            Report(
                "launch/c.launch.xml:2:63",
                "static_transform_publisher has no option '--tx': it ends at once; closest: '--x'",
            ),
        ),
        Example(
            "a value without an option",
            {
                "launch/a.launch.py": _LAUNCH.format(
                    "'0.1', '--frame-id', 'a', '--child-frame-id', 'b'"
                )
            },
            Report("8:25", "'0.1' follows no option: static_transform_publisher ends at once"),
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
            Report(
                "launch/a.launch.py:7:9",
                "5 arguments, static_transform_publisher takes 8 or 9 of them: it "
                "ends at once; write --frame-id, --child-frame-id and --x, --y, ...",
            ),
            Report(
                "launch/b.launch.py:7:9",
                "angles and a quaternion: static_transform_publisher ends at once; "
                "give one of them",
            ),
            Report("launch/c.launch.xml:2:63", "'a' is its own parent: tf2 ignores the transform"),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for launch in LaunchFile.of_package(package):
            for call in launch.find("Node"):
                if launch.text(call, "executable") != _PROGRAM or "arguments" not in call.given:
                    continue
                elements = launch.evaluator.elements(call.given["arguments"])
                words = [launch.evaluator.joined_text(item.node) for item in elements.items]
                if not elements.complete or not elements.items:
                    continue
                # What is not known is a value; an option is written as it is.
                texts = [word if isinstance(word, str) else "$" for word in words]
                places = [launch.location(item.node) for item in elements.items]
                yield from self._check(package, texts, places, call.location)
        for file in markup_files(package):
            for node in file.nodes:
                arguments = node.arguments
                program = node.executable
                if program is None or program.value != _PROGRAM or arguments is None:
                    continue
                texts = arguments.value.split()
                if "$(" in arguments.value:
                    continue
                places = [arguments.location] * len(texts)
                yield from self._check(package, texts, places, arguments.location)

    def _check(
        self, package: Package, words: Sequence[str], places: Sequence[Location], whole: Location
    ) -> Iterator[Diagnostic]:
        words = [*words[: words.index("--ros-args")]] if "--ros-args" in words else [*words]
        options = [index for index, word in enumerate(words) if word.startswith("--")]
        if not options:
            if len(words) not in _POSITIONAL and "$" not in words:
                message = (
                    f"{len(words)} arguments, {_PROGRAM} takes 8 or 9 of them: it ends at once; "
                    "write --frame-id, --child-frame-id and --x, --y, ..."
                )
                yield self.report(whole, message)
            return
        unknown = [index for index in options if words[index] not in (*_VALUES, *_FRAMES, "--help")]
        for index in unknown:
            closest = closest_name(package, words[index], (*_VALUES, *_FRAMES), 0.6)
            hint = f"; closest: {closest!r}" if closest else ""
            message = f"{_PROGRAM} has no option {words[index]!r}: it ends at once{hint}"
            yield self.report(places[index], message)
        for index, word in enumerate(words):
            if index not in options and index - 1 not in options and not unknown:
                message = f"{word!r} follows no option: {_PROGRAM} ends at once"
                yield self.report(places[index], message)
        for frame in _FRAMES:
            if frame not in words and not unknown:
                yield self.report(whole, f"no {frame!r}: {_PROGRAM} ends at once, it must be given")
        given = {words[index] for index in options}
        if given & {"--roll", "--pitch", "--yaw"} and given & {"--qx", "--qy", "--qz", "--qw"}:
            message = f"angles and a quaternion: {_PROGRAM} ends at once; give one of them"
            yield self.report(whole, message)
        frames = [words[words.index(frame) + 1 :][:1] for frame in _FRAMES if frame in words]
        if len(frames) == len(_FRAMES) and frames[0] == frames[1] != ["$"]:
            message = f"{frames[0][0]!r} is its own parent: tf2 ignores the transform"
            yield self.report(whole, message)
