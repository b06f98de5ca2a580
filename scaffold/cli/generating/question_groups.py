"""Questions of templates as flags, in groups for `--help`."""

from __future__ import annotations

import argparse
from collections.abc import Collection, Iterable, Mapping, Sequence

from scaffold.generate.questions import questions
from scaffold.generate.templates.template import PARTS, Question, Role, Template

SEE_ALSO = (
    "`ros2-scaffold templates` describes the kinds and extras, `ros2-scaffold interfaces` lists "
    "the types."
)
_OF_NODES: Mapping[str, str] = {
    **dict.fromkeys(("topic", "message", "qos"), "nodes: topics"),
    **dict.fromkeys(
        ("service_name", "service", "action_name", "action"), "nodes: services and actions"
    ),
    "frame": "nodes: frames",
}
"""The groups of node questions by answer type."""
_GROUPS = (
    *("the package", "nodes", "nodes: topics", "nodes: services and actions", "nodes: frames"),
    *("interfaces", "C++ programs", "extras"),
)
_OF_ROLES: Mapping[Role, str] = {
    Role.PACKAGE: "the package",
    Role.BUILD_TYPE: "the package",
    Role.NODE: "nodes",
    Role.INTERFACE: "interfaces",
    Role.PROGRAM: "C++ programs",
    Role.EXTRA: "extras",
}


def add(
    parser: argparse.ArgumentParser,
    templates: Iterable[Template],
    kinds: Mapping[str, Sequence[Question]] | None = None,
    *,
    only: Collection[str] | None = None,
    package: argparse._ArgumentGroup | None = None,
) -> None:
    """Define the flags of the templates' questions.

    Args:
        parser: The parser of the verb.
        templates: The templates, the base first.
        kinds: The kinds of parts and their questions, for tab completion.
        only: The names of the questions to define; all by default.
        package: The group of flags about the package, if there is one already.
    """
    listed = [*templates]
    groups: dict[str, list[Question]] = {}
    roles = _roles(listed)
    for question in questions.shared(listed):
        if only is None or question.name in only:
            groups.setdefault(_group(question, roles[question.name]), []).append(question)
    for name in _GROUPS:
        if name in groups:
            has_one = package is not None and name == _OF_ROLES[Role.PACKAGE]
            group = package if has_one else parser.add_argument_group(name)
            questions.add_flags(group or parser, groups[name], kinds)


def _roles(templates: Iterable[Template]) -> dict[str, list[Role]]:
    """Return the roles of the templates that ask a question."""
    result: dict[str, list[Role]] = {}
    for template in templates:
        for question in template.questions:
            result.setdefault(question.name, []).append(template.role)
    return result


def _group(question: Question, roles: Sequence[Role]) -> str:
    role = min(roles, key=[Role.PACKAGE, Role.BUILD_TYPE, *PARTS, Role.EXTRA].index)
    of_role = _OF_ROLES[role]
    return _OF_NODES.get(question.type, of_role) if role is Role.NODE else of_role
