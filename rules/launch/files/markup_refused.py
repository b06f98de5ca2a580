"""LF046: launch files in XML have elements, attributes and substitutions that launch knows."""

from __future__ import annotations

import re
from collections import Counter
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
    listed_names,
)
from scaffold.api.install import share_of
from scaffold.api.launch import (
    BY_LAUNCH,
    MarkupElement,
    MarkupFile,
    included_at,
    markup_files,
    may_be_set_elsewhere,
    substitution_words,
)

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
_LISTS = frozenset({"children", "choice", "launch"})
"""Keys of YAML besides those of actions and their parts."""
_INCLUDED = re.compile(r"\$\(find-pkg-share ([\w-]+)\)/([\w./-]+)")
_MAX_EVAL_ARGUMENTS = 2
"""$(eval ...) takes an expression, and the modules that it uses."""
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
    other_severities = {
        Severity.WARNING: "the launch file is not installed, or an included one ignores an argument"
    }
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
                "config/preset.yaml": "launch:\n- arg:\n    name: rate\n    default: '1'\n",
                "launch/a.launch.xml": "<launch><node exec='$(var kind)' args='$(var rate)'/>"
                "</launch>\n",
                "launch/b.launch.xml": "<launch><arg name='kind'/>"
                "<include file='$(find-pkg-share talker)/config/preset.yaml'/>\n"
                "<include file='a.launch.xml'/>\n"
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
        Example(
            "an expression without quotes",
            {"launch/a.launch.xml": _RIGHT.replace("&quot;1 &lt; 2&quot;", "$(var robot) == a")},
            "4:38: $(eval ...) takes one expression: put it in quotes",
        ),
        Example(
            "a configuration that is set too late",
            {
                "launch/a.launch.xml": _RIGHT.replace(
                    "</launch>", "<arg name='b'/></launch>"
                ).replace("$(var robot)", "$(var b)")
            },
            "3:27: $(var b) is read before the file sets it: the launch stops",
        ),
        Example(
            "keys of YAML",
            {
                "launch/a.launch.yaml": "launch:\n- arg:\n    name: rate\n    default: '1'\n"
                "- group:\n  - push_ros_namespace:\n      namespace: a\n  - node:\n"
                "      pkg: talker\n      exec: talk\n      param:\n"
                "      - name: rate\n        value: $(var rate)\n"
            },
        ),
        Example(
            "unknown keys, and a configuration that is not set, in YAML",
            {
                "launch/a.launch.yaml": "launch:\n- args:\n    name: rate\n- node:\n"
                "    pkg: talker\n    exec: talk\n    params:\n"
                "    - name: rate\n      value: $(var rate)\n"
            },
            "2:3: 'launch' has no key 'args': the launch stops; did you mean 'arg'?",
            "7:5: 'node' has no key 'params': the launch stops; did you mean 'param'?",
            "9:14: $(var rate) is never set; declared here: nothing",
        ),
        Example(
            "an argument that the included file does not have",
            {
                "package.xml": "<package><name>talker</name></package>\n",
                "launch/a.launch.xml": "<launch>\n"
                "  <include file='$(find-pkg-share talker)/launch/b.launch.xml'>\n"
                "    <arg name='rate' value='1'/>\n    <arg name='speed' value='1'/>\n"
                "  </include>\n</launch>\n",
                "launch/b.launch.xml": "<launch>\n  <arg name='rate'/>\n</launch>\n",
            },
            Report(
                "launch/a.launch.xml:4:16",
                "launch/b.launch.xml has no argument 'speed': it is ignored; it has rate",
                severity=Severity.WARNING,
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        if not package.build_type.startswith("ament"):
            return
        share = share_of(package)
        for file in markup_files(package):
            is_installed = not share.complete or file.path in share.files.values()
            severity = Severity.ERROR if is_installed else Severity.WARNING
            for element in file.elements:
                for at, problem in _problems(element, is_xml=file.path.endswith(".xml")):
                    cause = _CAUSE if "ROS 1" in problem else ""
                    yield self.report(at, problem, severity=severity, cause=cause)
            for at, problem in _unset(package, file):
                yield self.report(at, problem, severity=severity)
            for at, problem in _ignored(package, file):
                yield self.report(at, problem, severity=Severity.WARNING)


def _unset(package: Package, file: MarkupFile) -> Iterator[tuple[Location, str]]:
    """Yield the configurations that are read before something sets them, once each."""
    elements = sorted(file.elements, key=lambda item: (item.location.line, item.location.column))
    setters = [item.attributes["name"].value for item in elements if _is_setter(item)]
    names = {*setters} | BY_LAUNCH
    has_includes = any(element.tag == "include" for element in elements)
    is_set = set(BY_LAUNCH)
    for element in elements:
        for attribute in element.attributes.values():
            for name in re.findall(r"\$\(var ([\w-]+)\)", attribute.value):
                if name in is_set or may_be_set_elsewhere(package, file.path, name):
                    continue
                is_set.add(name)
                if name in names:
                    problem = f"$(var {name}) is read before the file sets it: the launch stops"
                    yield attribute.location, problem
                elif not has_includes or _closest(name, names):
                    declared = listed_names(names - BY_LAUNCH, name, "nothing")
                    problem = f"$(var {name}) is never set; declared here: {declared}"
                    yield attribute.location, problem
        if _is_setter(element):
            is_set.add(element.attributes["name"].value)
        elif element.tag == "include":
            is_set |= names  # perhaps by the included file


def _ignored(package: Package, file: MarkupFile) -> Iterator[tuple[Location, str]]:
    """Yield the arguments of includes that the included file of the workspace does not have."""
    setters = Counter(item.attributes["name"].value for item in file.elements if _is_setter(item))
    given = Counter(name.value for item in file.elements for name in item.arguments)
    for element in file.elements:
        target = element.attributes.get("file") if element.tag == "include" else None
        path = _INCLUDED.fullmatch(target.value) if target is not None else None
        other = included_at(package, path[1], path[2]) if path is not None else None
        if other is None or other.is_open:
            continue
        for name in element.arguments:
            is_declared = given[name.value] < setters[name.value]
            if name.value not in other.names and not is_declared:
                has = listed_names(other.names, name.value, "none")
                problem = (
                    f"{other.path} has no argument {name.value!r}: it is ignored; it has {has}"
                )
                yield name.location, problem


def _is_setter(element: MarkupElement) -> bool:
    return element.tag in {"arg", "let"} and "name" in element.attributes


def _problems(element: MarkupElement, *, is_xml: bool) -> Iterator[tuple[Location, str]]:
    known = attributes_of(element.tag)
    if not is_xml:
        yield from _of_keys(element, known)
    elif element.tag in _TAGS:
        use = _TAGS[element.tag]
        yield element.location, f"<{element.tag}> is ROS 1 syntax: the launch stops; use {use}"
        return
    elif known is not None:
        yield from _of_attributes(element, known)
    elif closest := _closest(element.tag, [*ACTIONS, *PARTS]):
        problem = f"unknown element <{element.tag}>: the launch stops; did you mean <{closest}>?"
        yield element.location, problem
    for attribute in element.attributes.values():
        for kind in re.findall(r"(?<!\\)\$\(([\w-]+)[ )]", attribute.value):
            problem = _of_substitution(kind)
            if problem:
                yield attribute.location, problem
        for name, *words in substitution_words(attribute.value):
            if name == "eval" and len(words) > _MAX_EVAL_ARGUMENTS:
                yield attribute.location, "$(eval ...) takes one expression: put it in quotes"


def _of_keys(
    element: MarkupElement, known: frozenset[str] | None
) -> Iterator[tuple[Location, str]]:
    """Yield the keys of YAML that an action must not have, also among the actions of a list."""
    children = {*ACTIONS, *PARTS, *_LISTS}
    places = {name: key.name_location for name, key in element.attributes.items()}
    for name, at in (places | element.nested).items():
        if known is None and element.tag not in _LISTS:
            continue
        is_of_python = element.tag in ACTIONS and name in OF_PYTHON and name in element.attributes
        if name in (known or ()) or (name in children and not is_of_python):
            continue
        closest = _closest(name, {*(known or ()), *children})
        if is_of_python:
            use = OF_PYTHON[name].removeprefix("<").split(" ")[0].rstrip("/>")
            problem = f"{element.tag!r} has no key {name!r}, which belongs to Python"
            yield at, f"{problem}; YAML has {use}"
        elif closest:
            yield (
                at,
                f"{element.tag!r} has no key {name!r}: the launch stops; did you mean {closest!r}?",
            )


def _of_attributes(element: MarkupElement, known: frozenset[str]) -> Iterator[tuple[Location, str]]:
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
        yield element.location, f"<{tag}> needs the attribute {missing[0]!r}"


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
