"""LF046: launch files in XML are written as ROS 2 reads them."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

from scaffold.api import Diagnostic, Example, Package, Rule, ViewError
from scaffold.api.formats import Element, xml_reader

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
    """A launch file in XML uses elements, attributes or substitutions of ROS 1.

    **Why.** ``ros2 launch`` stops: ``Attribute 'exec' of Entity node not found``, ``Unknown
    substitution: find``.

    **Fix.** Write the equivalent of ROS 2.

    **Source.** ROS 2 documentation, "Migrating launch files from ROS 1 to ROS 2".
    """

    code = "LF046"
    name = "markup-of-ros1"
    examples = (
        Example("of ROS 2", {"launch/a.launch.xml": _LAUNCH.format("exec", "a")}),
        Example(
            "of ROS 1",
            {"launch/a.launch.xml": _LAUNCH.format("type", "$(arg name)")},
            "2:28: 'type' of <node> belongs to ROS 1; ROS 2 has exec",
            "2:40: $(arg ...) belongs to ROS 1; ROS 2 has $(var name)",
        ),
        Example(
            "an element of ROS 1",
            {"launch/a.launch.xml": "<launch>\n  <rosparam file='a.yaml'/>\n</launch>\n"},
            "2:4: <rosparam> belongs to ROS 1; ROS 2 has <param from='...'/>",
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
            for element in document.root.descendants():
                yield from self._check(element)

    def _check(self, element: Element) -> Iterator[Diagnostic]:
        if element.tag in _TAGS:
            message = f"<{element.tag}> belongs to ROS 1; ROS 2 has {_TAGS[element.tag]}"
            yield self.report(element.name_location, message, cause=_CAUSE)
        for name, attribute in element.attributes.items():
            new = _ATTRIBUTES.get((element.tag, name))
            if new is not None:
                message = f"{name!r} of <{element.tag}> belongs to ROS 1; ROS 2 has {new}"
                yield self.report(attribute.location, message, cause=_CAUSE)
            for kind in re.findall(r"\$\((\w+) ", attribute.value):
                if kind in _SUBSTITUTIONS:
                    message = f"$({kind} ...) belongs to ROS 1; ROS 2 has {_SUBSTITUTIONS[kind]}"
                    yield self.report(attribute.location, message, cause=_CAUSE)
