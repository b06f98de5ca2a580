"""Valid names of topics, services, nodes and namespaces in ROS 2."""

from __future__ import annotations

import re

MAX_NODE_NAME = 255
"""``RMW_NODE_NAME_MAX_NAME_LENGTH`` of ``rmw/validate_node_name.h``."""
MAX_TOPIC_NAME = 247
"""``RMW_TOPIC_MAX_NAME_LENGTH`` of ``rmw/validate_full_topic_name.h``."""
SUBSTITUTIONS = frozenset({"node", "ns", "namespace"})
"""``{node}``, ``{ns}``, ``{namespace}``: what rcl expands."""


def topic_problem(name: str) -> str | None:
    """Return the problem with the name of a topic, service or action as written.

    ``rcl/validate_topic_name.c`` before expansion, ``rmw/validate_full_topic_name.c`` after it.
    """
    if not name:
        return "it is empty"
    plain = re.sub(r"\{[^{}]*\}", "x", name)
    return _character_problem(name, plain) or _form_problem(name, plain)


def part_problem(part: str) -> str | None:
    """Return the problem with a part of such a name, whatever the rest."""
    wrong = re.search(r"[^A-Za-z0-9_/~{}]", part)
    if wrong:
        return f"{_shown(wrong[0])} is not allowed"
    return "'//' is not allowed" if "//" in part else None


def _character_problem(name: str, plain: str) -> str | None:
    if name.startswith("~") and name[1:2] != "/" and len(name) > 2:  # noqa: PLR2004  rcl takes ~a
        return "'~' must be followed by '/'"
    wrong = re.search(r"[^A-Za-z0-9_/~]", plain)
    if wrong:
        return f"{_shown(wrong[0])} is not allowed"
    if "~" in name[1:]:
        return "'~' is allowed only at the beginning"
    for substitution in re.findall(r"\{([^{}]*)\}", name):
        if substitution not in SUBSTITUTIONS:
            return f"'{{{substitution}}}' is not one of {{node}}, {{ns}} and {{namespace}}"
    return None


def _form_problem(name: str, plain: str) -> str | None:
    if "//" in re.sub(r"\{(?:ns|namespace)\}", "/x", name):
        return "'//' is not allowed" + (" (a namespace begins with '/')" if "{" in name else "")
    if name == "/":
        return "it is nothing but '/'"
    if name.endswith("/"):
        return "it ends with '/'"
    for token in plain.split("/"):
        if token[:1].isdigit():
            return f"{token!r} begins with a digit"
    if len(name) > MAX_TOPIC_NAME:
        return f"it has {len(name)} characters; {MAX_TOPIC_NAME} are allowed"
    return None


def _shown(character: str) -> str:
    return "whitespace" if character.isspace() else repr(character)


def node_problem(name: str) -> str | None:
    """Return the problem with the name of a node (``rmw/validate_node_name.c``)."""
    if not name:
        return "it is empty"
    wrong = re.search(r"[^A-Za-z0-9_]", name)
    if wrong:
        return f"{_shown(wrong[0])} is not allowed"
    if name[0].isdigit():
        return "it begins with a digit"
    if len(name) > MAX_NODE_NAME:
        return f"it has {len(name)} characters; {MAX_NODE_NAME} are allowed"
    return None


def namespace_problem(name: str) -> str | None:
    """Return the problem with a namespace given to a node (``rmw/validate_namespace.c``)."""
    if name in {"", "/"}:
        return None
    if "~" in name or "{" in name:
        return "'~' and '{' are not allowed"
    return topic_problem(name if name.startswith("/") else f"/{name}")
