"""SP056: every entry point has its own name."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule
from scaffold.api.setup_py import EntryPoint

_SETUP = (
    "from setuptools import setup\n\nsetup(\n    name='talker',\n    packages=['talker'],\n"
    "    entry_points={{'console_scripts': [\n"
    "        'talker = talker.node:main',\n"
    "        '{} = talker.other:main',\n"
    "    ]}},\n)\n"
)


class EntryPointRepeated(Rule):
    """Two entry points have the same name.

    **Why.** Only the last is made: ``ros2 run`` never starts the program of the other.

    **Fix.** Give each a name of its own.

    **Source.** Python Packaging User Guide, "Entry points specification".
    """

    code = "SP056"
    name = "entry-point-repeated"
    examples = (
        Example("two names", {"setup.py": _SETUP.format("listener")}),
        Example(
            "one name",
            {"setup.py": _SETUP.format("talker")},
            Report("8:9", "'talker' is the name of another entry point: only one is installed"),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        seen: dict[str, EntryPoint] = {}
        for entry in package.setup_py.console_scripts:
            first = seen.setdefault(entry.name, entry)
            if first is not entry and entry.name:
                message = (
                    f"{entry.name!r} is the name of another entry point: only one is installed"
                )
                yield self.report(entry, message)
