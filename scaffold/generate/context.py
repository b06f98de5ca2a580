"""The variables of templates: answers, and names and texts derived from them."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator, Mapping, Sequence
from datetime import date, datetime, timezone
from pathlib import Path
from typing import Any

from scaffold import distributions, lazy_re
from scaffold.distributions import Distribution
from scaffold.errors import ContentError, InputError
from scaffold.generate import target
from scaffold.generate.parts import Part
from scaffold.generate.questions import names
from scaffold.generate.questions.questions import flag
from scaffold.generate.templates import licenses
from scaffold.generate.templates.render import Renderer
from scaffold.generate.templates.template import (
    DEPEND_KINDS,
    MANIFEST,
    PARTS,
    Question,
    Role,
    Template,
)
from scaffold.model.catalog import BUILD_TOOLS

_DEPENDENCY = lazy_re.compile(r"[A-Za-z0-9][\w.+-]*")
"""A package or a key of rosdep."""
_IMPORT = lazy_re.compile(r"import ([A-Z]\w*(?:, [A-Z]\w*)*)")

VERSION = "0.1.0"
"""The version of a new package; 0.0.0 would be a placeholder."""
PARAMETERS = "_parameters.yaml.jinja"
"""The template file with the parameter values of a kind of node, for launch files."""


def package_context(
    answers: Mapping[str, Any],
    layers: Sequence[Template],
    parts: Sequence[Part],
    renderer: Renderer,
    day: date,
    subdirectory: str = "",
    targets: Sequence[Distribution] = (),
) -> dict[str, Any]:
    """Return the variables of all files.

    Besides the answers: ``version``, ``date``, ``year``, ``tutorial``, ``header`` (the license as
    comment lines), ``has_license`` (false where an existing package has decided for none that there
    are templates for), ``subdirectory`` (the way from the top of the git repository to the package;
    empty at the top), ``license_text`` and ``contributing_text`` (the templates of the full text
    and of CONTRIBUTING.md), ``nodes``, ``interfaces`` and ``programs``, ``depends`` (names by
    kind), ``groups``, ``tests`` (of extras), ``share_directories``, ``other_programs`` (names of
    those in an existing package that are not known to be nodes) and ``target`` (see
    `scaffold.generate.target`). A part has the answers of its template, ``kind``, ``name`` and
    ``summary``; a node also has ``module``, ``class_name``, ``executable``, ``parameter_file``,
    ``has_parameters`` and the full names of its topics, services and actions; an interface has
    ``file`` and ``type``.

    Raises:
        InputError: two answers contradict each other.
    """
    context: dict[str, Any] = {
        **answers,
        **_settings(answers, day),
        "subdirectory": subdirectory,
        "target": target.context(targets or [distributions.target()]),
    }
    context["header"] = renderer.license_header(answers["license"], context)
    for role in PARTS:
        context[f"{role.value}s"] = [
            _part_context(part, layers, context, renderer)
            for part in parts
            if part.template.role is role
        ]
    scopes = list(part_scopes(layers, context))
    context["other_programs"] = []
    context["tests"] = _texts("tests", scopes, renderer)
    context["depends"] = _depends(scopes, context, renderer)
    context["groups"] = _texts("groups", scopes, renderer)
    context["share_directories"] = _texts("installs", scopes, renderer)
    return context


def _settings(answers: Mapping[str, Any], day: date) -> dict[str, Any]:
    """Return what follows from the day, the license and the style of the comments."""
    license_files = f"{licenses.DIRECTORY}/{answers['license']}"
    return {
        "version": VERSION,
        "date": day.isoformat(),
        "year": day.year,
        "tutorial": answers["comments"] == "tutorial",
        "has_license": True,
        "license_text": f"{license_files}/{licenses.TEXT}",
        "contributing_text": f"{license_files}/{licenses.CONTRIBUTING}",
    }


def part_scopes(
    layers: Iterable[Template], context: Mapping[str, Any]
) -> Iterator[tuple[Template, Mapping[str, Any]]]:
    """Yield each template with the variables of its files, once for each of its parts."""
    for layer in layers:
        if layer.role not in PARTS:
            yield layer, context
            continue
        for part in context[f"{layer.role.value}s"]:
            if part["kind"] == layer.name:
                yield layer, {**context, layer.role.value: part}


def today() -> date:
    """Return the date for new files; ``SOURCE_DATE_EPOCH`` makes it reproducible.

    Raises:
        InputError: the variable is set to something else than seconds.
    """
    epoch = os.environ.get("SOURCE_DATE_EPOCH")
    if not epoch:
        return datetime.now().astimezone().date()
    try:
        return datetime.fromtimestamp(int(epoch), tz=timezone.utc).date()
    except (ValueError, OverflowError, OSError):
        raise InputError(f"SOURCE_DATE_EPOCH: {epoch!r} is not a number of seconds") from None


def _part_context(
    part: Part, layers: Iterable[Template], context: Mapping[str, Any], renderer: Renderer
) -> dict[str, Any]:
    template = part.template
    result = {
        **part.answers,
        "kind": template.name,
        "name": part.name,
        "summary": template.summary,
    }
    if template.role is Role.NODE:
        return _node(result, part, layers, context, renderer)
    if template.role is Role.INTERFACE:
        ending = template.definition
        result["file"] = f"{ending}/{part.name}.{ending}"
        result["type"] = f"{context['package']}/{ending}/{part.name}"
    return result


def _node(
    node: dict[str, Any],
    part: Part,
    layers: Iterable[Template],
    context: Mapping[str, Any],
    renderer: Renderer,
) -> dict[str, Any]:
    name, package = part.name, context["package"]
    if name == package:
        raise InputError(
            f"--node-name: {name!r} is the name of the package; the script of the node would "
            "shadow the package"
        )
    _refuse_two_classes(part)
    taken = [item for value in part.answers.values() for item in getattr(value, "class_names", ())]
    taken += _imported_classes(part.template)
    node |= {"module": name, "class_name": names.class_name(name, taken)}
    flags: dict[tuple[str, str], str] = {}
    for question in part.template.questions:
        if question.type in _GRAPH_NAMES:
            full_name = _full_name(question, node[question.name], name)
            _refuse_own(question, full_name, name)
            node[f"{question.name}_name"] = full_name
            other = flags.setdefault((question.type, full_name), flag(question.name))
            if other != flag(question.name):
                raise InputError(
                    f"{other} and {flag(question.name)} are both {full_name!r}: the node would "
                    "receive its own messages"
                )
    build = next(layer for layer in layers if layer.role is Role.BUILD_TYPE)
    scope = {**context, "node": node}
    node["executable"] = renderer.text(build.executable_name, scope)
    node["parameter_file"] = renderer.text(part.template.parameter_file, scope)
    values = f"{part.template.name}/{PARAMETERS}"
    node["has_parameters"] = renderer.has(values) and bool(renderer.file(values, scope).strip())
    return node


def _imported_classes(template: Template) -> Iterator[str]:
    """Yield the classes that the module of a node imports by name."""
    for directory in template.directories:
        for path in Path(directory).glob("*/*.py.jinja"):
            if path.parent.name != "test":
                for classes in _IMPORT.findall(path.read_text("utf-8", "replace")):
                    yield from classes.split(", ")


def _refuse_two_classes(part: Part) -> None:
    """Raise if two answers bring different classes of one name into the node's module.

    ``Duration`` is a message, and what the settings of a quality of service are written with.
    """
    origins: dict[str, tuple[str, str]] = {}
    for name, value in part.answers.items():
        for line in getattr(value, "imports", ()):
            module, _, classes = line.removeprefix("from ").partition(" import ")
            for item in filter(None, classes.split(", ")):  # none where a module is imported
                first, other = origins.setdefault(item, (module, name))
                if first != module:
                    raise InputError(
                        f"{flag(name)}: {item} of {module} and {item} of {first} (for "
                        f"{flag(other)}) cannot be in one module; change one of them"
                    )


_GRAPH_NAMES = frozenset({"topic", "service_name", "action_name"})
"""The types of answers that ROS resolves to a full name."""


def _full_name(question: Question, given: str, node: str) -> str:
    name = names.resolve(given, node)
    if len(name) > names.MAX_TOPIC:
        raise InputError(
            f"{flag(question.name)}: {given!r} is {name!r} in full, {len(name)} characters long; "
            f"the limit is {names.MAX_TOPIC}"
        )
    return name


_OWN_NAMES: Mapping[str, frozenset[str]] = {
    "topic": frozenset({"transition_event"}),
    "service_name": frozenset(
        {"describe_parameters", "get_parameter_types", "get_parameters", "get_type_description"}
        | {"list_parameters", "set_parameters", "set_parameters_atomically"}
    ),
}
"""What nodes have below their own names, by the type of the question."""


def _refuse_own(question: Question, full_name: str, node: str) -> None:
    """Raise if ROS itself gives every node this name."""
    own = full_name.removeprefix(f"/{node}/")
    if own != full_name and own in _OWN_NAMES.get(question.type, ()):
        kind = question.type.partition("_")[0]
        raise InputError(
            f"{flag(question.name)}: {full_name!r} is a {kind} that ROS itself gives each node"
        )


_WIDER: Mapping[str, str] = {
    "exec": "depend",
    "build": "depend",
    "build_export": "depend",
    "test": "exec",
}
"""Kinds of dependencies, and the kind that covers each."""


def _depends(
    scopes: Iterable[tuple[Template, Mapping[str, Any]]],
    context: Mapping[str, Any],
    renderer: Renderer,
) -> dict[str, list[str]]:
    """Return the dependencies of all layers by kind, each once and in alphabetical order."""
    result: dict[str, set[str]] = {kind: set() for kind in DEPEND_KINDS}
    for layer, scope in scopes:
        for kind, texts in layer.depends.items():
            for text in texts:
                result[kind].update(_names(layer, kind, text, renderer.text(text, scope)))
    for name in context["dependencies"]:
        if name == context["package"]:
            raise InputError(f"--dependencies: {name} is the package itself")
        if name in result["buildtool"] or name in BUILD_TOOLS:
            raise InputError(f"--dependencies: {name} is a build tool; nodes do not need it")
        result["exec"].add(name)
    for kind in ("test", "exec", "build", "build_export"):
        wider: str | None = _WIDER[kind]
        while wider is not None:
            result[kind] -= result[wider]
            wider = _WIDER.get(wider)
    return {kind: sorted(result[kind] - {context["package"]}) for kind in DEPEND_KINDS}


def _names(layer: Template, kind: str, text: str, rendered: str) -> list[str]:
    """Return the names in a rendered entry of ``depends``."""
    names = rendered.split()
    if not all(map(_DEPENDENCY.fullmatch, names)):
        raise ContentError(
            f"{os.path.join(layer.directory, MANIFEST)}: depends: {kind}: {text!r} is "
            f"{rendered!r}, not names separated by spaces; a list needs join(' ')"
        )
    return names


def _texts(
    key: str, scopes: Iterable[tuple[Template, Mapping[str, Any]]], renderer: Renderer
) -> list[str]:
    """Return the texts that the layers have under a key, each once, in alphabetical order."""
    texts = {renderer.text(text, scope) for layer, scope in scopes for text in getattr(layer, key)}
    return sorted(texts - {""})
