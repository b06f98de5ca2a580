"""PF007: rcl accepts the values of parameter files."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule
from scaffold.api.parameters import parameter_file, parameter_paths

_FILE = "talker:\n  ros__parameters:\n    rate: {}\n"


class ValueRefused(Rule):
    """A parameter file is valid YAML, but contains a value that rcl rejects.

    **Why.** The node does not start: ``RCLError: failed to initialize rcl: Couldn't parse params
    file ... No value at line 3``, ``Will not support aliasing``, ``Sequences cannot be key``,
    ``There are no node names before ros__parameters``.

    **Fix.** Write every value out, without aliases; flatten lists of lists.

    **Source.** ``rcl_yaml_param_parser/src/parse.c``.
    """

    code = "PF007"
    name = "value-refused"
    examples = (
        Example("values", {"a.yaml": _FILE.format("[1.0, 2.0]"), "b.yaml": _FILE.format("''")}),
        Example(
            "no value; an alias; a list in a list",
            {
                "a.yaml": _FILE.format(""),
                "b.yaml": _FILE.format("&rate 2.0\n    more: *rate"),
                "c.yaml": _FILE.format("[[1.0, 2.0], [3.0]]"),
            },
            Report(
                "a.yaml:3:5",
                "'rate' has no value: rcl rejects the file; write '' for an empty string",
            ),
            Report(
                "b.yaml:4:11", "'more' is the alias *rate: rcl rejects the file; write the value"
            ),
            Report("c.yaml:3:12", "'rate' is a list of lists: rcl rejects the file; flatten it"),
        ),
        Example(
            "no node; no parameters",
            {
                "a.yaml": "ros__parameters:\n  rate: 2.0\n",
                "b.yaml": "talker:\n  ros__parameters:\n",
            },
            Report("a.yaml:1:1", "no node name above 'ros__parameters': rcl rejects the file"),
            Report("b.yaml:2:3", "no parameters under 'ros__parameters': rcl rejects the file"),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for path in parameter_paths(package):
            file = parameter_file(package, path)
            for refused in file.refused if file else ():
                yield self.report(refused.location, refused.message)
