"""PF002: parameters stand under ros__parameters."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Edit, Example, Fix, Package, Report, Rule
from scaffold.api.launch import consumers, is_loaded, use_of
from scaffold.api.parameters import KEY, Misplaced, parameter_file, parameter_paths

_FILE = "talker:\n  {}:\n    rate: 2.0\n"


class RosParametersMissing(Rule):
    """Parameters of a file do not stand under ``ros__parameters``, or that is misspelt.

    **Why.** The node does not start: ``RCLError: failed to initialize rcl: Couldn't parse params
    file ... Cannot have a value before ros__parameters at line 3``.

    **Fix.** Node name, then ``ros__parameters`` with two underscores, then the parameters.

    **Source.** ``rcl_yaml_param_parser/src/parse.c``; ROS 2 documentation, "Passing ROS arguments
    to nodes".
    """

    code = "PF002"
    name = "ros-parameters-missing"
    examples = (
        Example("two underscores", {"config/talker.yaml": _FILE.format("ros__parameters")}),
        Example(
            "a node that is called so",
            {"config/a.yaml": _FILE.format("ros__parameters").replace("talker", "parameters")},
        ),
        Example(
            "one underscore; too few letters",
            {
                "config/a.yaml": _FILE.format("ros_parameters"),
                "config/b.yaml": _FILE.format("ros__parameter"),
            },
            reports=(
                Report(
                    "config/a.yaml:2:3",
                    "ros_parameters is no key of a parameter file; it is ros__parameters",
                    fix="write ros__parameters",
                ),
                Report(
                    "config/b.yaml:2:3",
                    "ros__parameter is no key of a parameter file; it is ros__parameters",
                    fix="write ros__parameters",
                ),
            ),
            fixed={
                "config/a.yaml": _FILE.format("ros__parameters"),
                "config/b.yaml": _FILE.format("ros__parameters"),
            },
        ),
        Example(
            "left out for one node of two",
            {"config/a.yaml": _FILE.format("ros__parameters") + "listener:\n  rate: 1.0\n"},
            reports=(
                Report(
                    "config/a.yaml:5:3",
                    "'rate' stands under no ros__parameters: node name, ros__parameters, value",
                ),
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        paths = parameter_paths(package)
        paths += [path for path in self._given(package) if path not in paths]
        for path in paths:
            file = parameter_file(package, path)
            if file is None or not file.misplaced:
                continue
            is_given = bool(use_of(package, path).nodes)
            is_read = is_given or bool(file.sections and not is_loaded(package, path))
            for one in file.misplaced[:1]:
                if one.near is not None and (is_read or self._is_meant(file.misplaced)):
                    edit = Edit(path, one.near.start, one.near.end, KEY)
                    message = f"{one.near.text} is no key of a parameter file; it is {KEY}"
                    yield self.report(one.near, message, Fix(f"write {KEY}", (edit,)))
                elif one.near is None and is_read:
                    message = f"{one.key.text!r} stands under no {KEY}: node name, {KEY}, value"
                    yield self.report(one.key, message)

    def _is_meant(self, misplaced: list[Misplaced]) -> bool:
        """Tell a parameter file from one of another tool that has such a key somewhere."""
        return all(one.near is not None and one.depth == 1 for one in misplaced)

    def _given(self, package: Package) -> Iterator[str]:
        """Yield the files that launch files give to nodes."""
        for node in consumers(package):
            for path, _ in node.parameter_files:
                if package.has(path) and path.endswith((".yaml", ".yml")):
                    yield path
