"""PF001: parameter files and launch files are valid YAML."""

from __future__ import annotations

import re
from collections.abc import Container, Iterator
from contextlib import suppress

from scaffold.api import Diagnostic, Effect, Example, Package, Rule
from scaffold.api.launch import is_loaded, markup_paths, use_of
from scaffold.api.parameters import mistake, parameter_paths

_LAUNCH = "launch:\n- node: {{pkg: talker, exec: talker{}\n- node: {{pkg: talker, exec: ear}}\n"
_OTHER_FORMATS = rb"\A%YAML:|\{%|\{\{"
_MAX_LENGTH = 64_000
"""The maximum size of a hand-written file in bytes."""
_POINTS = "points:\n- [1.0, 2.0\n- [3.0, 4.0]\n"
_LOADING = (
    "import yaml\n\n\ndef points(share):\n"
    "    with open(share + '/config/points.yaml') as file:\n"
    "        return yaml.safe_load(file)\n"
)
_FILE = "talker:\n  ros__parameters:\n{}"


class YamlMalformed(Rule):
    """A parameter file or launch file is not valid YAML.

    **Why.** The node does not start: ``RCLError: failed to initialize rcl: Couldn't parse params
    file ... Error parsing a event near line 2``. A launch file fails, too: ``The launch file may
    have a syntax error, or its format is unknown``.

    **Fix.** Correct the syntax; indent with spaces.

    **Source.** ``rcl_yaml_param_parser``; YAML 1.2, section 6.1.
    """

    code = "PF001"
    name = "yaml-malformed"
    effect = Effect.STOPS_START
    examples = (
        Example("valid", {"config/talker.yaml": _FILE.format("    rate: 2.0\n")}),
        Example(
            "a tab, an unclosed bracket, an extra colon",
            {
                "config/a.yaml": _FILE.format("\trate: 2.0\n"),
                "config/b.yaml": _FILE.format("    rates: [1.0, 2.0\n    next: 1\n"),
                "config/c.yaml": _FILE.format("    rate: 2.0: 3\n"),
            },
            "config/a.yaml:3:1: line is indented with a tab; YAML allows only spaces",
            "config/b.yaml:4:1: not YAML: did not find expected ',' or ']' while parsing a flow "
            "sequence",
            "config/c.yaml:3:1: not YAML: mapping values are not allowed in this context",
        ),
        Example(
            "an unused file; a template; a file of OpenCV",
            {
                "config/points.yaml": _POINTS,
                "config/camera.yaml": "%YAML:1.0\n---\n" + _POINTS,
                "config/arm.yaml": "{% if sim %}\n" + _POINTS,
                "talker/read.py": _LOADING.replace("points.y", "camera.y")
                + _LOADING.replace("points.y", "arm.y"),
            },
        ),
        Example(
            "a file that code loads",
            {"config/points.yaml": _POINTS, "talker/read.py": _LOADING},
            "config/points.yaml:3:1: not YAML: did not find expected ',' or ']' while parsing a "
            "flow sequence",
        ),
        Example(
            "launch files",
            {
                "launch/a.launch.yaml": _LAUNCH.format("}"),
                "launch/b.launch.yaml": _LAUNCH.format(""),
            },
            "launch/b.launch.yaml:3:1: not YAML: did not find expected ',' or '}' while parsing a "
            "flow mapping",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        launched = [path for path in markup_paths(package) if not path.endswith(".xml")]
        paths = dict.fromkeys([*parameter_paths(package), *launched])
        for path in [*paths, *_written_by_hand(package, paths)]:
            error = mistake(package, path)
            if error is not None and (path in paths or _is_read(package, path)):
                yield self.report(error.location, error.message)


def _written_by_hand(package: Package, paths: Container[str]) -> Iterator[str]:
    """Yield the other YAML files, except those of tests and of other tools.

    Files of OpenCV have a special header; templates are not YAML yet.
    """
    for path in package.files:
        is_of_tests = not {"test", "tests"}.isdisjoint(path.split("/"))
        if path in paths or is_of_tests or not path.endswith((".yaml", ".yml")):
            continue
        with suppress(OSError):
            if re.search(_OTHER_FORMATS, package.bytes_of(path, _MAX_LENGTH)) is None:
                yield path


def _is_read(package: Package, path: str) -> bool:
    """Return whether a launch file passes a file to a node, or code in the workspace loads it."""
    return bool(use_of(package, path).nodes) or is_loaded(package, path)
