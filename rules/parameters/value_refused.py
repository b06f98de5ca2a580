"""PF007: values are of a form that rcl reads."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule
from scaffold.api.parameters import parameter_file, parameter_paths

_FILE = "talker:\n  ros__parameters:\n    rate: {}\n"


class ValueRefused(Rule):
    """A parameter file is YAML, but has something that rcl does not take.

    **Why.** The node does not start: ``RCLError: failed to initialize rcl: Couldn't parse params
    file ... No value at line 3``, ``Will not support aliasing``, ``Sequences cannot be key``,
    ``There are no node names before ros__parameters``.

    **Fix.** Write every value out; lists of lists as one list.

    **Source.** ``rcl_yaml_param_parser/src/parse.c``.
    """

    code = "PF007"
    name = "value-refused"
    examples = (
        Example("values", {"a.yaml": _FILE.format("[1.0, 2.0]"), "b.yaml": _FILE.format("''")}),
        Example(
            "nothing; an alias; a list in a list",
            {
                "a.yaml": _FILE.format(""),
                "b.yaml": _FILE.format("&rate 2.0\n    more: *rate"),
                "c.yaml": _FILE.format("[[1.0, 2.0], [3.0]]"),
            },
            reports=(
                Report("a.yaml:3:5", "rate has no value; write ~ or '' for an empty string"),
                Report("b.yaml:4:11", "more is the alias *rate; rcl has no aliases"),
                Report("c.yaml:3:12", "rate is a list of lists; rcl has none"),
            ),
        ),
        Example(
            "no node; no parameters",
            {
                "a.yaml": "ros__parameters:\n  rate: 2.0\n",
                "b.yaml": "talker:\n  ros__parameters:\n",
            },
            reports=(
                Report("a.yaml:1:1", "no node name stands above ros__parameters"),
                Report("b.yaml:2:3", "ros__parameters holds no parameters"),
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for path in parameter_paths(package):
            file = parameter_file(package, path)
            for found in file.refused if file else ():
                yield self.report(found.location, found.message)
