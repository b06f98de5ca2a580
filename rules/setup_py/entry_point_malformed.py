"""SP002: console scripts have the form ``name = module:function``."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule

_SETUP = (
    "from setuptools import setup\n\n"
    "setup(\n    entry_points={{'console_scripts': [\n{}    ]}},\n)\n"
)


class EntryPointMalformed(Rule):
    """A console script does not have the form ``name = module:function``.

    **Why.** setuptools stops the build, or makes one bogus executable out of two lines: two
    strings without a comma between them are one string.

    **Fix.** Write ``'name = package.module:function'`` and a comma after each.

    **Source.** Python packaging user guide, "Entry points specification".
    """

    code = "SP002"
    name = "entry-point-malformed"
    examples = (
        Example("one", {"setup.py": _SETUP.format("        'talker = talker.node:main',\n")}),
        Example(
            "a comma is missing",
            {
                "setup.py": _SETUP.format(
                    "        'talker = talker.node:main'\n"
                    "        'listener = listener.node:main',\n"
                )
            },
            Report("5:9", "missing comma after this console script: it is joined to the next"),
        ),
        Example(
            "no function",
            {"setup.py": _SETUP.format("        'talker = talker.node',\n")},
            Report(
                "5:9",
                "console script 'talker = talker.node': no function is named: name "
                "= module:function",
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for entry in package.setup_py.console_scripts:
            if len(entry.joined) > 1 and entry.text.count("=") > 1:
                at = entry.joined[0]
                message = "missing comma after this console script: it is joined to the next"
                yield self.report(at, message)
            elif entry.malformed:
                yield self.report(entry, f"console script {entry.text!r}: {entry.malformed}")
