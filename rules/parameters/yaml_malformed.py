"""PF001: parameter files and launch files are valid YAML."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule
from scaffold.api.launch import markup_paths
from scaffold.api.parameters import mistake, parameter_paths

_LAUNCH = "launch:\n- node: {{pkg: talker, exec: talker{}\n- node: {{pkg: talker, exec: ear}}\n"
_FILE = "talker:\n  ros__parameters:\n{}"


class YamlMalformed(Rule):
    """A parameter file or a launch file cannot be read as YAML.

    **Why.** The node does not start: ``RCLError: failed to initialize rcl: Couldn't parse params
    file ... Error parsing a event near line 2``. Nor does a launch file: ``The launch file may have
    a syntax error, or its format is unknown``.

    **Fix.** Correct the syntax; indent with spaces.

    **Source.** ``rcl_yaml_param_parser``; YAML 1.2, section 6.1.
    """

    code = "PF001"
    name = "yaml-malformed"
    examples = (
        Example("valid", {"config/talker.yaml": _FILE.format("    rate: 2.0\n")}),
        Example(
            "a tab, an unclosed bracket, a stray colon",
            {
                "config/a.yaml": _FILE.format("\trate: 2.0\n"),
                "config/b.yaml": _FILE.format("    rates: [1.0, 2.0\n    next: 1\n"),
                "config/c.yaml": _FILE.format("    rate: 2.0: 3\n"),
            },
            Report("config/a.yaml:3:1", "line is indented with a tab; YAML allows only spaces"),
            Report(
                "config/b.yaml:4:1",
                "not YAML: did not find expected ',' or ']' while parsing a flow sequence",
            ),
            Report("config/c.yaml:3:1", "not YAML: mapping values are not allowed in this context"),
        ),
        Example(
            "launch files",
            {
                "launch/a.launch.yaml": _LAUNCH.format("}"),
                "launch/b.launch.yaml": _LAUNCH.format(""),
            },
            Report(
                "launch/b.launch.yaml:3:1",
                "not YAML: did not find expected ',' or '}' while parsing a flow mapping",
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        launched = [path for path in markup_paths(package) if not path.endswith(".xml")]
        for path in dict.fromkeys([*parameter_paths(package), *launched]):
            error = mistake(package, path)
            if error is not None:
                yield self.report(error.location, error.message)
