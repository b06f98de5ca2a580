"""LF083: programs are given options that they have."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Edit, Example, Fix, Package, Report, Rule
from scaffold.api.distributions import of_kind
from scaffold.api.launch import CommandLine, Word, processes

_LAUNCH = (
    "from launch.actions import ExecuteProcess\n\n"
    "RECORDER = ExecuteProcess(cmd=['ros2', 'bag', 'record', '-a', {}])\n"
)
_XML = "<launch>\n  <executable cmd='ros2 bag record -a {}'/>\n</launch>\n"


class OptionRemoved(Rule):
    """A launch file starts a program with an option that was removed in the distribution.

    **Why.** The program ends at once, with ``ambiguous option`` or ``unrecognized arguments``.

    **Fix.** Use its replacement.

    **Source.** rosbag2, ``ros2bag/verb/record.py``.
    """

    code = "LF083"
    name = "option-removed"
    is_fixed_for_all = True
    since = "0.2"
    examples = (
        Example(
            "still there",
            {"launch/a.launch.py": _LAUNCH.format("'--exclude', '/tf'")},
            distro="humble",
        ),
        Example(
            "its successor",
            {"launch/a.launch.py": _LAUNCH.format("'--exclude-regex', '/tf'")},
        ),
        Example(
            "gone",
            {
                "launch/a.launch.py": _LAUNCH.format("'--exclude', '/tf'"),
                "launch/b.launch.py": _LAUNCH.format('"-x", "/tf"'),
                "launch/c.launch.xml": _XML.format("--exclude=/tf"),
            },
            Report(
                "launch/a.launch.py:3:63",
                "--exclude of ros2 bag record was removed in Jazzy: it ends at once; "
                "use --exclude-regex (rosbag2 1480)",
                fix="write --exclude-regex",
            ),
            Report(
                "launch/b.launch.py:3:63",
                "-x of ros2 bag record was removed in Jazzy: it ends at once; "
                "use --exclude-regex (rosbag2 1480)",
                fix="write --exclude-regex",
            ),
            Report(
                "launch/c.launch.xml:2:20",
                "--exclude of ros2 bag record was removed in Jazzy: it ends at once; "
                "use --exclude-regex (rosbag2 1480)",
                fix="write --exclude-regex",
            ),
            fixed={
                "launch/a.launch.py": _LAUNCH.format("'--exclude-regex', '/tf'"),
                "launch/b.launch.py": _LAUNCH.format('"--exclude-regex", "/tf"'),
                "launch/c.launch.xml": _XML.format("--exclude-regex=/tf"),
            },
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        removed = {
            name: change
            for change in of_kind("option")
            for name in change.names
            if change.is_removed
        }
        for line in processes(package) if removed else ():
            program = " ".join(word.text for word in line.words[:3])
            for word in line.words[3:]:
                option = word.text.partition("=")[0]
                change = removed.get(f"{program} {option}")
                if change is not None:
                    message = f"{option} of {program} {change.state}: it ends at once; "
                    message += f"{change.instead(change.use)} ({change.source})"
                    edit = _edit(package, line, word, option, change.use)
                    is_fixed = edit is not None and change.has_replacement
                    fix = Fix(f"write {change.use}", (edit,)) if edit and is_fixed else None
                    yield self.report(word.location, message, fix)


def _edit(package: Package, line: CommandLine, word: Word, old: str, new: str) -> Edit | None:
    """Return the edit of the option, where it is written as it is read."""
    if line.launch is not None and word.node is not None:
        module = line.launch.module
        start = module.span(word.node)[0] + 1  # after the quote
        path, text = line.launch.path, package.source(line.launch.path).text
    elif line.attribute is not None and word.span is not None:
        at, path = line.attribute.location, line.attribute.location.path
        start = package.source(path).offset(at.line, at.column) + word.span[0]
        text = package.source(path).text
    else:
        return None
    return Edit(path, start, start + len(old), new) if text.startswith(old, start) else None
