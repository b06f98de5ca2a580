"""LF081: launch files start programs that stay."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Location, Package, Rule, Severity
from scaffold.api.distributions import of_kind
from scaffold.api.launch import markup_files, package_uses

_LAUNCH = (
    "from launch import LaunchDescription\n"
    "from launch_ros.actions import ComposableNodeContainer\n\n\n"
    "def generate_launch_description():\n"
    "    return LaunchDescription([\n"
    "        ComposableNodeContainer(\n"
    "            name='container', namespace='', package='rclcpp_components',\n"
    "            executable='{}'),\n    ])\n"
)
_XML = "<launch>\n  <node_container pkg='rclcpp_components' exec='{}' name='a'/>\n</launch>\n"


class ExecutableDeprecated(Rule):
    """A launch file starts a program that the distribution is about to remove.

    **Why.** It warns at each start, and a later distribution does not have it: the launch stops.

    **Fix.** Start its replacement. No automatic fix: the arguments differ, and older distributions
    do not have them.

    **Source.** The pull requests that ``scaffold/data/changes.toml`` names.
    """

    code = "LF081"
    name = "executable-deprecated"
    severity = Severity.INFO
    is_deprecation = True
    examples = (
        Example(
            "still usual",
            {"launch/a.launch.py": _LAUNCH.format("component_container_mt")},
        ),
        Example(
            "what stays",
            {"launch/a.launch.py": _LAUNCH.format("component_container")},
            distro="lyrical",
        ),
        Example(
            "containers with executors of their own",
            {
                "launch/a.launch.py": _LAUNCH.format("component_container_mt"),
                "launch/b.launch.xml": _XML.format("component_container_isolated"),
            },
            "launch/a.launch.py:9:24: component_container_mt is deprecated since Lyrical: it "
            "warns at each start; use component_container with the arguments --executor-type "
            "multi-threaded (rclcpp 3134)",
            "launch/b.launch.xml:2:49: component_container_isolated is deprecated since Lyrical: "
            "it warns at each start; use component_container with the arguments --isolated "
            "--executor-type single-threaded (rclcpp 3134)",
            distro="lyrical",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        changes = {
            name: change
            for change in of_kind("executable")
            for name in change.names
            if change.is_deprecated
        }
        for name, location in _started(package) if changes else ():
            change = changes.get(name)
            if change is not None:
                program = name.rpartition("/")[2]
                message = f"{program} {change.state}: it warns at each start; "
                message += f"{change.instead(change.use)} ({change.source})"
                yield self.report(location, message)


def _started(package: Package) -> Iterator[tuple[str, Location]]:
    """Yield what launch files start, as ``package/program``, with the place."""
    for use in package_uses(package):
        yield f"{use.name}/{use.executable}", use.executable_location
    for file in markup_files(package):
        for node in file.containers:
            if node.package is not None and node.executable is not None:
                yield f"{node.package.value}/{node.executable.value}", node.executable.location
