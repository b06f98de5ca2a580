"""LF046: XML launch files use the syntax of ROS 2."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

from scaffold.api import Diagnostic, Example, Location, Package, Report, Rule, Severity, ViewError
from scaffold.api.formats import Element, xml_reader
from scaffold.api.install import share_of

_TAGS: Mapping[str, str] = {"rosparam": "<param from='...'/>", "machine": "no equivalent"}
_ATTRIBUTES: Mapping[tuple[str, str], str] = {
    ("node", "type"): "exec",
    ("node", "ns"): "namespace",
    ("node", "clear_params"): "no equivalent",
    ("include", "ns"): "<push_ros_namespace>",
    ("group", "ns"): "<push_ros_namespace>",
    ("arg", "doc"): "description",
    ("param", "command"): "$(command '...')",
}
_SUBSTITUTIONS: Mapping[str, str] = {
    "arg": "$(var name)",
    "find": "$(find-pkg-share package)",
    "optenv": "$(env NAME default)",
}
_CAUSE = "launch files of ROS 1"
_LAUNCH = "<launch>\n  <node pkg='talker' {}='node' name='{}'/>\n</launch>\n"


class MarkupOfRos1(Rule):
    """An XML launch file uses elements, attributes or substitutions of ROS 1.

    **Why.** ``ros2 launch`` stops: ``Attribute 'exec' of Entity node not found``, ``Unknown
    substitution: find``.

    **Fix.** Use the ROS 2 equivalent in the message.

    **Source.** ROS 2 documentation, "Migrating launch files from ROS 1 to ROS 2".
    """

    code = "LF046"
    name = "markup-of-ros1"
    other_severities = {Severity.WARNING: "the launch file is not installed"}
    examples = (
        Example("syntax of ROS 2", {"launch/a.launch.xml": _LAUNCH.format("exec", "a")}),
        Example(
            "syntax of ROS 1",
            {"launch/a.launch.xml": _LAUNCH.format("type", "$(arg name)")},
            "2:28: 'type' of <node> is ROS 1 syntax: the launch stops; use exec",
            "2:40: $(arg ...) is ROS 1 syntax: the launch stops; use $(var name)",
        ),
        Example(
            "an element of ROS 1",
            {"launch/a.launch.xml": "<launch>\n  <rosparam file='a.yaml'/>\n</launch>\n"},
            "2:4: <rosparam> is ROS 1 syntax: the launch stops; use <param from='...'/>",
        ),
        Example(
            "syntax of ROS 1, in a file that is not installed",
            {
                "package.xml": "<package><name>talker</name>"
                "<export><build_type>ament_cmake</build_type></export></package>\n",
                "CMakeLists.txt": "project(talker)\nfind_package(ament_cmake REQUIRED)\n"
                "install(DIRECTORY launch DESTINATION share/${PROJECT_NAME})\nament_package()\n",
                "old/a.launch.xml": _LAUNCH.format("type", "a"),
                "launch/b.launch.xml": _LAUNCH.format("type", "b"),
            },
            "launch/b.launch.xml:2:28: 'type' of <node> is ROS 1 syntax: the launch stops; use "
            "exec",
            Report(
                "old/a.launch.xml:2:28",
                "'type' of <node> is ROS 1 syntax: the launch stops; use exec",
                severity=Severity.WARNING,
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        if not package.build_type.startswith("ament"):
            return
        for path in package.files:
            if not path.endswith(".launch.xml") or {"test", "tests"} & set(path.split("/")):
                continue
            try:
                document = xml_reader.parse(xml_reader.decode(path, package.data(path)))
            except ViewError:
                continue
            share = share_of(package)
            is_installed = not share.complete or path in share.files.values()
            severity = Severity.ERROR if is_installed else Severity.WARNING
            for element in document.root.descendants():
                for at, problem in _problems(element):
                    yield self.report(at, problem, severity=severity, cause=_CAUSE)


def _problems(element: Element) -> Iterator[tuple[Location, str]]:
    if element.tag in _TAGS:
        yield (
            element.name_location,
            f"<{element.tag}> is ROS 1 syntax: the launch stops; use {_TAGS[element.tag]}",
        )
    for name, attribute in element.attributes.items():
        new = _ATTRIBUTES.get((element.tag, name))
        if new is not None:
            problem = f"{name!r} of <{element.tag}> is ROS 1 syntax: the launch stops; use {new}"
            yield attribute.location, problem
        for kind in re.findall(r"\$\((\w+) ", attribute.value):
            if kind in _SUBSTITUTIONS:
                problem = (
                    f"$({kind} ...) is ROS 1 syntax: the launch stops; use {_SUBSTITUTIONS[kind]}"
                )
                yield attribute.location, problem
