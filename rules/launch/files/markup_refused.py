"""LF046: launch files in XML have elements, attributes and substitutions that launch knows."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Mapping
from difflib import get_close_matches

from scaffold.api import (
    Diagnostic,
    Example,
    Location,
    Package,
    Report,
    Rule,
    Severity,
    ViewError,
    listed_names,
)
from scaffold.api.formats import Element, xml_reader
from scaffold.api.install import share_of
from scaffold.api.launch import BY_LAUNCH, markup_files, may_be_set_elsewhere

from ._markup import ACTIONS, OF_PYTHON, PARTS, REQUIRED, SUBSTITUTIONS, attributes_of

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
_RIGHT = (
    "<launch>\n  <arg name='robot' default='a'><choice value='a'/></arg>\n"
    "  <let name='file' value='$(find-pkg-share talker)/$(var robot).yaml'/>\n"
    "  <node pkg='talker' exec='node' if='$(eval &quot;1 &lt; 2&quot;)'>\n"
    "    <param name='rate' value='1.0'/>\n    <param name='names' value='a,b' value-sep=','/>\n"
    "    <remap from='a' to='b'/>\n    <env name='A' value='b'/>\n  </node>\n"
    "  <custom_action of='another package'/>\n</launch>\n"
)
_LAUNCH = "<launch>\n  <node pkg='talker' {}='node' name='{}'/>\n</launch>\n"


class MarkupRefused(Rule):
    """A launch file in XML or YAML uses a name that launch does not know.

    Often one of ROS 1, or an argument of a launch file in Python.

    **Why.** ``ros2 launch`` stops: ``Attribute 'exec' of Entity node not found``, ``Unexpected
    attribute(s) found in `node`: {'package'}``, ``Unknown substitution: find``, ``launch
    configuration 'robt' does not exist``.

    **Fix.** Write the equivalent of ROS 2 in XML.

    **Source.** ROS 2 documentation, "Migrating launch files from ROS 1 to ROS 2";
    ``launch_xml/entity.py``, ``assert_entity_completely_parsed``; the methods ``parse`` of
    ``launch/actions`` and ``launch_ros/actions``.
    """

    code = "LF046"
    name = "markup-refused"
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
            "arguments of Python in YAML",
            {
                "launch/a.launch.yaml": "launch:\n- node:\n    package: talker\n"
                "    executable: talk\n- node:\n    pkg: talker\n    exec: hear\n"
            },
            "3:5: 'node' has no key 'package', which belongs to Python; YAML has pkg",
            "4:5: 'node' has no key 'executable', which belongs to Python; YAML has exec",
        ),
        Example(
            "everything in its place",
            {"launch/a.launch.xml": _RIGHT},
        ),
        Example(
            "attributes and a substitution that are not known",
            {
                "launch/a.launch.xml": _RIGHT.replace("exec=", "executable=")
                .replace("<remap from='a'", "<remap form='a'")
                .replace("find-pkg-share", "find-package-share")
                .replace("name='rate'", "name='rate' if='true'"),
            },
            "3:27: unknown substitution $(find-package-share ...): the launch stops; did you mean "
            "$(find-pkg-share ...)?",
            "4:34: <node> has no attribute 'executable', which belongs to Python; XML has exec",
            "5:28: <param> has no attribute 'if'",
            "7:18: <remap> has no attribute 'form'; did you mean 'from'?",
        ),
        Example(
            "a configuration that nothing sets",
            {"launch/a.launch.xml": _RIGHT.replace("(var robot)", "(var robt)")},
            "3:27: $(var robt) is never set; declared here: file, robot",
        ),
        Example(
            "a configuration that the including file sets, or an included one",
            {
                "launch/a.launch.xml": "<launch><node exec='$(var kind)'/></launch>\n",
                "launch/b.launch.xml": "<launch><arg name='kind'/><include file='a.launch.xml'/>\n"
                "<include file='$(find-pkg-share other)/c.launch.xml'/>\n"
                "<node exec='$(var other)'/></launch>\n",
            },
        ),
        Example(
            "an attribute that is missing, a misspelled element",
            {
                "launch/a.launch.xml": _RIGHT.replace(" to='b'", "").replace("<let", "<lett"),
            },
            "3:4: unknown element <lett>: the launch stops; did you mean <let>?",
            "7:6: <remap> needs the attribute 'to'",
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
        yield from self._check_yaml(package)
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
                    cause = _CAUSE if "ROS 1" in problem else ""
                    yield self.report(at, problem, severity=severity, cause=cause)
            for at, problem in _unset(package, path, document.root):
                yield self.report(at, problem, severity=severity)

    def _check_yaml(self, package: Package) -> Iterator[Diagnostic]:
        """Check for keys that are arguments of launch files in Python."""
        for file in markup_files(package):
            if file.path.endswith(".xml"):
                continue
            for element in file.elements:
                known = attributes_of(element.tag) if element.tag in ACTIONS else None
                for name, key in element.attributes.items():
                    if known is not None and name in OF_PYTHON and name not in known:
                        message = f"{element.tag!r} has no key {name!r}, which belongs to Python"
                        message = f"{message}; YAML has {_in_yaml(OF_PYTHON[name])}"
                        yield self.report(key.name_location, message)


def _in_yaml(markup: str) -> str:
    """Return the key of YAML for an attribute or element of XML."""
    return markup.removeprefix("<").split(" ")[0].rstrip("/>")


def _unset(package: Package, path: str, root: Element) -> Iterator[tuple[Location, str]]:
    """Yield the configurations that are read and that nothing sets, once each."""
    elements = list(root.descendants())
    setters = [element for element in elements if element.tag in {"arg", "let"}]
    names = {
        setter.attributes["name"].value for setter in setters if "name" in setter.attributes
    } | BY_LAUNCH
    has_includes = any(element.tag == "include" for element in elements)
    for element in elements:
        for attribute in element.attributes.values():
            for name in re.findall(r"\$\(var ([\w-]+)\)", attribute.value):
                is_open = has_includes and not _closest(name, names)
                if name in names or is_open or may_be_set_elsewhere(package, path, name):
                    continue
                names.add(name)
                declared = listed_names(names - BY_LAUNCH - {name}, name, "nothing")
                yield attribute.location, f"$(var {name}) is never set; declared here: {declared}"


def _problems(element: Element) -> Iterator[tuple[Location, str]]:
    of_ros1 = _TAGS.get(element.tag)
    if of_ros1 is not None:
        yield (
            element.name_location,
            f"<{element.tag}> is ROS 1 syntax: the launch stops; use {of_ros1}",
        )
        return
    known = attributes_of(element.tag)
    if known is None:
        closest = _closest(element.tag, [*ACTIONS, *PARTS])
        if closest:
            yield (
                element.name_location,
                f"unknown element <{element.tag}>: the launch stops; did you mean <{closest}>?",
            )
    else:
        yield from _of_attributes(element, known)
    for attribute in element.attributes.values():
        for kind in re.findall(r"(?<!\\)\$\(([\w-]+)[ )]", attribute.value):
            problem = _of_substitution(kind)
            if problem:
                yield attribute.location, problem


def _of_attributes(element: Element, known: frozenset[str]) -> Iterator[tuple[Location, str]]:
    """Yield the attributes that an element must not have, else those that it lacks."""
    tag, given = element.tag, element.attributes
    unknown = [name for name in given if name.removesuffix("-sep") not in known]
    for name in unknown:
        of_ros2 = _ATTRIBUTES.get((tag, name))
        if of_ros2 is not None:
            problem = f"{name!r} of <{tag}> is ROS 1 syntax: the launch stops; use {of_ros2}"
        else:
            problem = f"<{tag}> has no attribute {name!r}{_hint(name, known)}"
        yield given[name].location, problem
    missing = [name for name in REQUIRED.get(tag, ()) if name not in given]
    if missing and not unknown:
        yield element.name_location, f"<{tag}> needs the attribute {missing[0]!r}"


def _hint(name: str, known: frozenset[str]) -> str:
    """Return what to write for an unknown attribute."""
    if name in OF_PYTHON:
        return f", which belongs to Python; XML has {OF_PYTHON[name]}"
    closest = _closest(name, known)
    return f"; did you mean {closest!r}?" if closest else ""


def _of_substitution(kind: str) -> str:
    """Return the problem with the name of a substitution; empty if there is none."""
    if kind in _SUBSTITUTIONS:
        return f"$({kind} ...) is ROS 1 syntax: the launch stops; use {_SUBSTITUTIONS[kind]}"
    closest = _closest(kind, SUBSTITUTIONS) if kind not in SUBSTITUTIONS else ""
    if not closest:
        return ""
    return f"unknown substitution $({kind} ...): the launch stops; did you mean $({closest} ...)?"


def _closest(word: str, names: Collection[str]) -> str:
    """Return the most similar name; empty if there is none."""
    return "".join(get_close_matches(word, sorted(names), 1, 0.7))
