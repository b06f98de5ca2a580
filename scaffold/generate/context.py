"""What templates may use: answers, and the names and texts made of them."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping, Sequence
from datetime import date, datetime, timezone
from typing import Any

from scaffold.errors import InputError
from scaffold.generate import licenses, names
from scaffold.generate.render import Renderer
from scaffold.generate.template import DEPEND_KINDS, Role, Template

VERSION = "0.1.0"
"""Of a new package: nothing is released yet, and 0.0.0 would be a placeholder."""


def package_context(
    answers: Mapping[str, Any], layers: Sequence[Template], renderer: Renderer
) -> dict[str, Any]:
    """Return the variables of all files.

    Besides the answers: ``version``, ``date``, ``year``, ``tutorial``, ``header`` (the licence as
    comment lines), ``license_text`` (the template of the full text), ``nodes`` and ``depends``
    (names by kind). A node has the answers of its template and ``kind``, ``name``, ``module``,
    ``class_name``, ``executable`` and ``topic_name``.

    Raises:
        InputError: two answers contradict each other.
    """
    day = today()
    context: dict[str, Any] = {
        **answers,
        "version": VERSION,
        "date": day.isoformat(),
        "year": day.year,
        "tutorial": answers["comments"] == "tutorial",
        "license_text": f"{licenses.DIRECTORY}/{answers['license']}/{licenses.TEXT}",
    }
    context["header"] = renderer.license_header(answers["license"], context)
    context["nodes"] = [
        _node(layer, layers, context, renderer) for layer in layers if layer.role is Role.NODE
    ]
    context["depends"] = _depends(layers, context, renderer)
    return context


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


def _node(
    layer: Template, layers: Iterable[Template], context: Mapping[str, Any], renderer: Renderer
) -> dict[str, Any]:
    name = context["node_name"]
    package = context["package"]
    if name == package:
        raise InputError(
            f"--node-name: {name!r} is the name of the package, its script would hide it"
        )
    node = {question.name: context[question.name] for question in layer.questions}
    message = node.get("message_type")
    node |= {
        "kind": layer.name,
        "name": name,
        "module": name,
        "class_name": names.class_name(name, [message.name] if message else []),
    }
    if "topic" in node:
        node["topic_name"] = _topic_name(node["topic"], name)
    build = next(one for one in layers if one.role is Role.BUILD_TYPE)
    node["executable"] = renderer.text(build.executable_name, {**context, "node": node})
    return node


def _topic_name(topic: str, node: str) -> str:
    name = names.resolve(topic, node)
    if len(name) > names.MAX_TOPIC:
        raise InputError(
            f"--topic: {topic!r} is {name!r} in full, {len(name)} characters long; "
            f"the limit is {names.MAX_TOPIC}"
        )
    return name


def _depends(
    layers: Iterable[Template], context: Mapping[str, Any], renderer: Renderer
) -> dict[str, list[str]]:
    """Return the dependencies of all layers by kind, each once and in alphabetical order."""
    found: dict[str, set[str]] = {kind: set() for kind in DEPEND_KINDS}
    for layer in layers:
        nodes = [n for n in context["nodes"] if n["kind"] == layer.name]
        for scope in [{**context, "node": n} for n in nodes] or [dict(context)]:
            for kind, texts in layer.depends.items():
                found[kind].update(renderer.text(text, scope) for text in texts)
    for name in context["dependencies"]:
        if name == context["package"]:
            raise InputError(f"--dependencies: {name} is the package itself")
        if name in found["buildtool"]:
            raise InputError(f"--dependencies: {name} builds the package; nodes do not need it")
        found["test"].discard(name)
        found["exec"].add(name)
    return {kind: sorted(found[kind]) for kind in DEPEND_KINDS}
