"""From what the user gave to a package in memory, checked before anything is written."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, NamedTuple

from scaffold.errors import ContentError, InputError
from scaffold.generate import questions
from scaffold.generate.context import package_context
from scaffold.generate.defaults import User
from scaffold.generate.questions import Given
from scaffold.generate.render import Rendered, Renderer
from scaffold.generate.template import BASE, Question, Role, Template

if TYPE_CHECKING:
    from scaffold.check.diagnostic import Diagnostic
    from scaffold.check.rule import Rule


class Draft(NamedTuple):
    """A package in memory."""

    name: str
    build_type: str
    executables: tuple[str, ...]
    """What ``ros2 run`` calls its nodes."""
    rendered: Rendered
    remarks: tuple[str, ...]
    """What the user should know, a line each."""


def draft(
    roots: Sequence[str], templates: Mapping[str, Template], given: Mapping[str, Given], user: User
) -> Draft:
    """Render a package.

    Args:
        roots: The ``templates`` directories; a later one wins.
        templates: The templates in them.
        given: The user's answers by question.
        user: Knows what was not given.

    Raises:
        InputError: an answer is missing, not acceptable, or of no use here.
        ContentError: a template is broken.
    """
    layers = _layers(templates, given)
    asked = questions.unique(layers)
    _refuse_useless(given, asked, layers)
    comments = _answer("comments", asked, given)
    renderer = Renderer(roots, templates, is_tutorial=comments == "tutorial")
    answers = questions.resolve(asked, given, render=renderer.text, fallback=user.answer)
    context = package_context(answers, layers, renderer)
    rendered = renderer.package(layers, context, context["nodes"])
    return Draft(
        name=context["package"],
        build_type=context["build_type"],
        executables=tuple(node["executable"] for node in context["nodes"]),
        rendered=rendered,
        remarks=_remarks(renderer, context, answers, user),
    )


def defects(package: Draft, rules: Sequence[type[Rule]]) -> list[Diagnostic]:
    """Return what the checker says about a draft: a defect of the templates."""
    from scaffold.check.selection import Selection
    from scaffold.check.session import Session
    from scaffold.model.package import Package
    from scaffold.model.tree import MemoryTree

    tree = MemoryTree(package.rendered.files, package.rendered.executable)
    return Session(rules, Selection()).check(Package(tree, directory=package.name))


def _layers(templates: Mapping[str, Template], given: Mapping[str, Given]) -> list[Template]:
    """Return the templates that the user chose: base, build type, kind of node."""
    base = templates[BASE]
    chosen = [base]
    for name in ("build_type", "node_kind"):
        answer = _answer(name, base.questions, given)
        if answer not in templates:
            raise ContentError(f"{base.directory}: the question {name} must choose a template")
        chosen.append(templates[answer])
    roles = [template.role for template in chosen]
    if roles != [Role.PACKAGE, Role.BUILD_TYPE, Role.NODE]:
        names = ", ".join(template.name for template in chosen)
        raise ContentError(f"the templates {names} must be a package, a build type and a node")
    return chosen


def _answer(name: str, asked: Sequence[Question], given: Mapping[str, Given]) -> str:
    """Return the answer to a question of the base that decides what is rendered."""
    for question in asked:
        if question.name == name:
            answer = given.get(name, Given(question.default, "default"))
            return str(questions.parse(question, answer))
    raise ContentError(f"the template {BASE!r} must ask for {name}")


def _refuse_useless(
    given: Mapping[str, Given], asked: Sequence[Question], layers: Sequence[Template]
) -> None:
    known = {question.name for question in asked}
    for name, answer in given.items():
        if name not in known and answer.origin.startswith("--"):
            chosen = " and ".join(template.name for template in layers[1:])
            raise InputError(f"{answer.origin}: of no use for {chosen}")


def _remarks(
    renderer: Renderer, context: Mapping[str, object], answers: Mapping[str, object], user: User
) -> tuple[str, ...]:
    remarks: list[str] = []
    note = renderer.license_note(str(answers["license"]), context)
    if note:
        remarks.append(note)
    if user.guessed:
        maintainer = f"{answers['maintainer_name']} <{answers['maintainer_email']}>"
        remarks.append(
            f"the maintainer is {maintainer}, as git knows no other: set user.name and "
            "user.email with `git config --global`, or "
            f"maintainer_name and maintainer_email in the table [new] of {_config_file()}"
        )
    return tuple(remarks)


def _config_file() -> str:
    base = os.environ.get("XDG_CONFIG_HOME") or "~/.config"
    return os.path.join(base, "ros2-scaffold", "config.toml")
