"""Builds a package in memory from the user's answers."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from datetime import date
from itertools import zip_longest
from types import MappingProxyType
from typing import Any, NamedTuple

from scaffold import distributions
from scaffold.configuration.config import USER_FILE
from scaffold.distributions import Distribution
from scaffold.errors import ContentError, InputError
from scaffold.files import home
from scaffold.generate import connections, parts, payload, target
from scaffold.generate.connections import Open, Use, clashes, conflicts, uses
from scaffold.generate.context import package_context, part_scopes, today
from scaffold.generate.parts import Part, Request
from scaffold.generate.questions import questions
from scaffold.generate.questions.defaults import User
from scaffold.generate.questions.questions import Given
from scaffold.generate.repository import NOWHERE, Place, unread
from scaffold.generate.templates.render import Rendered, Renderer
from scaffold.generate.templates.template import BASE, PARTS, Question, Role, Template


class Draft(NamedTuple):
    """A package in memory."""

    name: str
    build_type: str
    executables: tuple[str, ...]
    """The names of its nodes and programs for ``ros2 run``."""
    rendered: Rendered
    remarks: tuple[str, ...]
    """Notes for the user, one line each."""
    conflicts: tuple[str, ...]
    """Why its nodes would not connect, one line each."""
    answers: Mapping[str, Any]
    """Every answer, as in an answers file."""
    day: date
    """The date in its files."""
    roots: Sequence[str]
    """The directories of the templates."""
    targets: tuple[Distribution, ...]
    """Its target distributions, oldest first."""


class Order(NamedTuple):
    """The templates that the user chose."""

    layers: list[Template]
    """Package, build type, each kind of part once, extras."""
    requests: list[Request]

    @property
    def frame(self) -> list[Template]:
        """The templates whose questions are asked once for the package."""
        return [layer for layer in self.layers if layer.role not in PARTS]


def draft(
    roots: Sequence[str],
    templates: Mapping[str, Template],
    given: Mapping[str, Given],
    user: User,
    day: date | None = None,
    place: Place = NOWHERE,
) -> Draft:
    """Render a package.

    Args:
        roots: The ``templates`` directories; a later one wins.
        templates: The templates in them.
        given: The user's answers by question.
        user: Knows what was not given.
        day: The date for its files; today by default.
        place: The git repository that it is for.

    Raises:
        InputError: an answer is missing, not acceptable, or of no use here.
        ContentError: a template is broken.
    """
    targets = target.of(given)
    composed, rendered = _rendered(roots, templates, given, user, day, place, targets[0])
    for other in targets[1:]:
        _, theirs = _rendered(roots, templates, given, user, day, place, other)
        _refuse_different(rendered, theirs, targets[0], other)
    context, renderer = composed.context, composed.renderer
    return Draft(
        name=context["package"],
        build_type=context["build_type"],
        executables=(
            *(node["executable"] for node in context["nodes"]),
            *(program["name"] for program in context["programs"]),
        ),
        rendered=rendered,
        remarks=(
            *_remarks(renderer, context, user),
            *unread(place, rendered.unread, os.path.join(user.directory, context["package"])),
        ),
        conflicts=tuple(conflicts(context["nodes"], templates)),
        answers=composed.answers,
        day=date.fromisoformat(context["date"]),
        roots=roots,
        targets=tuple(targets),
    )


def _rendered(
    roots: Sequence[str],
    templates: Mapping[str, Template],
    given: Mapping[str, Given],
    user: User,
    day: date | None,
    place: Place,
    distribution: Distribution,
) -> tuple[Composed, Rendered]:
    """Return a package with the interfaces of a distribution."""
    with distributions.targeting(distribution):
        composed = compose(roots, templates, given, user, day=day, place=place)
        return composed, composed.renderer.package(part_scopes(composed.layers, composed.context))


def _refuse_different(
    rendered: Rendered, theirs: Rendered, first: Distribution, other: Distribution
) -> None:
    """Raise if the interfaces of two distributions lead to different files."""
    for path, text in sorted(rendered.files.items(), key=lambda item: item[0].startswith("test/")):
        lines, others = text.splitlines(), theirs.files[path].splitlines()
        if lines == others:
            continue
        pairs = enumerate(zip_longest(lines, others), 1)
        number, line = next((at, line or "") for at, (line, same) in pairs if line != same)
        raise InputError(
            f"--distro: no code works for both {first.title} and {other.title}: line {number} of "
            f"{path} would differ ({line.strip()!r}); make a package for each"
        )


class Composed(NamedTuple):
    """All answers and the values derived from them, before rendering."""

    layers: Sequence[Template]
    context: dict[str, Any]
    """The variables of all files."""
    renderer: Renderer
    answers: Mapping[str, Any]
    """Every answer, as in an answers file."""


class Existing(NamedTuple):
    """The parts of an existing package, if something is added to one."""

    answers: Mapping[str, Any] = MappingProxyType({})
    """Answers that are given by the package, such as its name."""
    messages: Sequence[str] = ()
    """The names of its own messages."""
    uses: Sequence[Use] = ()
    """The topics, services and actions of its nodes."""


@payload.looked_for_once()
def compose(
    roots: Sequence[str],
    templates: Mapping[str, Template],
    given: Mapping[str, Given],
    user: User,
    *,
    day: date | None = None,
    existing: Existing | None = None,
    place: Place = NOWHERE,
) -> Composed:
    """Choose templates and settle all questions.

    Args:
        roots: The ``templates`` directories; a later one wins.
        templates: The templates in them.
        given: The user's answers by question.
        user: Knows what was not given.
        day: The date for its files; today by default.
        existing: What the package has already, if it exists.
        place: The git repository that it is for.

    Raises:
        InputError: an answer is missing, not acceptable, or of no use here.
        ContentError: a template is broken.
    """
    order = choose(templates, given)
    asked = questions.unique(order.frame)
    _refuse_useless(given, order)
    comments = _base_answer("comments", asked, given)
    renderer = Renderer(roots, templates, is_tutorial=comments == "tutorial")
    existing = existing or Existing()
    settled = {**existing.answers, "contents": _contents(order)}
    answers = questions.resolve(
        [question for question in asked if question.name not in settled],
        given,
        context=settled,
        render=renderer.text,
        fallback=user.answer,
        where=user.directory,
    )
    values = {**existing.answers, **answers.values}
    settings = _Settings(given, values, renderer, user.directory)
    made, written = _parts(order.requests, settings, existing.uses)
    parts.refuse_impossible(made, values["package"], values["build_type"], existing.messages)
    day, subdirectory = day or today(), place.subdirectory(values["package"])
    targets = target.of(given)
    context = package_context(values, order.layers, made, renderer, day, subdirectory, targets)
    _refuse_clashes(context, templates)
    all_written = {**_without_key(answers.written, "node_kind"), parts.ADD: written}
    return Composed(order.layers, context, renderer, all_written)


def _refuse_clashes(context: Mapping[str, Any], templates: Mapping[str, Template]) -> None:
    """Raise InputError if a service or an action has two types."""
    for clash in clashes(uses(context["nodes"], templates)):
        if clash.first.kind != "topic":  # `new` rejects it, `update` cannot
            raise InputError(str(clash))


def _contents(order: Order) -> str:
    """Describe the contents of a package in words: its parts, or its extras."""
    alone = [layer.summary for layer in order.layers if layer.is_alone]
    return parts.contents(order.requests) or " and ".join(
        f"{summary[0].lower()}{summary[1:]}" for summary in alone
    )


def choose(templates: Mapping[str, Template], given: Mapping[str, Given]) -> Order:
    """Return the templates that the user's answers choose.

    Raises:
        InputError: there are no such templates, or they do not fit together.
        ContentError: the questions of the base do not choose templates.
    """
    base = templates[BASE]
    build = _template("build_type", Role.BUILD_TYPE, templates, given)
    extras = [templates[name] for name in _list_answer("extras", base.questions, given)]
    is_whole = any(extra.is_alone for extra in extras) and not any(
        extra.needs_nodes for extra in extras
    )
    has_parts = parts.ADD in given or bool(_NODE & given.keys())
    wanted = _requests(templates, given) if has_parts or not is_whole else []
    for extra in extras:
        parts.refuse_build_type(extra, build.name)
    kinds = {request.template.name: request.template for request in wanted}
    return Order([base, build, *kinds.values(), *extras], wanted)


_NODE = frozenset({"node_kind", "node_name"})
"""The questions for the only node of a package."""


def _requests(templates: Mapping[str, Template], given: Mapping[str, Given]) -> list[Request]:
    """Return the parts: those of ``add``, or the one node of ``node_kind``."""
    if parts.ADD not in given:
        node = _template("node_kind", Role.NODE, templates, given)
        name = node.name_question
        return [Request(node, {name: given[name]} if name in given else {}, "--node-kind")]
    for name in sorted(_NODE):
        if name in given and given[name].origin.startswith("--"):
            raise InputError(
                f"{given[name].origin}: cannot be combined with {questions.flag(parts.ADD)}"
            )
    question = next(item for item in templates[BASE].questions if item.name == parts.ADD)
    wanted = questions.parse(question, given[parts.ADD])
    return parts.requests(wanted, given[parts.ADD].origin, templates)


class _Settings(NamedTuple):
    """The settings from which the answers of parts are derived."""

    given: Mapping[str, Given]
    answers: Mapping[str, Any]
    renderer: Renderer
    where: str

    def resolve(self, request: Request, more: Mapping[str, Given]) -> questions.Answers:
        """Return the answers for a part."""
        return questions.resolve(
            request.template.questions,
            {**self.given, **request.given, **more},
            context=self.answers,
            render=self.renderer.text,
            fallback=lambda _: None,
            where=self.where,
        )


def _parts(
    wanted: Sequence[Request], settings: _Settings, neighbors: Sequence[Use]
) -> tuple[list[Part], list[dict[str, Any]]]:
    """Return the parts with their answers, and those answers as in an answers file.

    Where the user has not answered, a part takes the type and the quality of service of the nodes
    that it shares a topic with.
    """
    more: list[dict[str, Given]] = [{} for _ in wanted]
    resolved = [settings.resolve(request, {}) for request in wanted]
    for agreed in (connections.agreed_types, connections.agreed_qos):
        for index, request in enumerate(wanted):
            open_parts = [
                Open(
                    item.template,
                    own.values,
                    frozenset(settings.given.keys() | item.given.keys() | taken_over.keys()),
                )
                for item, own, taken_over in zip(wanted, resolved, more, strict=True)
            ]
            others = [part for at, part in enumerate(open_parts) if at != index]
            taken = agreed(open_parts[index], others, neighbors)
            if taken:
                more[index] |= taken
                resolved[index] = settings.resolve(request, more[index])
    made = [
        Part(request.template, own.values) for request, own in zip(wanted, resolved, strict=True)
    ]
    written = [
        {parts.KIND: request.template.name, **own.written}
        for request, own in zip(wanted, resolved, strict=True)
    ]
    return made, written


def _without_key(table: Mapping[str, Any], key: str) -> dict[str, Any]:
    return {name: value for name, value in table.items() if name != key}


def _template(
    name: str, role: Role, templates: Mapping[str, Template], given: Mapping[str, Given]
) -> Template:
    """Return the template that a question of the base chooses."""
    answer = _base_answer(name, templates[BASE].questions, given)
    if answer not in templates or templates[answer].role is not role:
        raise ContentError(
            f"{templates[BASE].directory}: the question {name} must choose a {role.value}"
        )
    return templates[answer]


def _list_answer(
    name: str, asked: Sequence[Question], given: Mapping[str, Given]
) -> tuple[str, ...]:
    result: tuple[str, ...] = ()
    for question in asked:
        if question.name == name:
            result = questions.parse(question, given.get(name, Given(question.default, "default")))
    return result


def _base_answer(name: str, asked: Sequence[Question], given: Mapping[str, Given]) -> str:
    """Return the answer to a question of the base that decides what is rendered."""
    for question in asked:
        if question.name == name:
            answer = given.get(name, Given(question.default, "default"))
            return str(questions.parse(question, answer))
    raise ContentError(f"the template {BASE!r} must ask for {name}")


def _refuse_useless(given: Mapping[str, Given], order: Order) -> None:
    names = {question.name for question in questions.unique(order.layers)}
    for name, answer in given.items():
        if name not in names and answer.origin.startswith("--"):
            chosen = " and ".join(template.name for template in order.layers[1:])
            raise InputError(f"{answer.origin}: does not apply to {chosen}")


def _remarks(renderer: Renderer, context: Mapping[str, object], user: User) -> tuple[str, ...]:
    remarks: list[str] = []
    note = renderer.license_note(str(context["license"]), context)
    if note:
        remarks.append(note)
    if user.guessed:
        maintainer = f"{context['maintainer_name']} <{context['maintainer_email']}>"
        remarks.append(
            f"the maintainer is {maintainer}, because git has no user.name and user.email: set "
            "them with `git config --global`, or set "
            f"maintainer_name and maintainer_email in the table [new] of {_config_file()}"
        )
    return tuple(remarks)


def _config_file() -> str:
    return os.path.join(home.configuration() or "~/.config/ros2-scaffold", USER_FILE)
