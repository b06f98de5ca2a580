"""The parts of a package: nodes, interfaces and programs."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any, NamedTuple

from scaffold.errors import InputError
from scaffold.generate.questions.fields import Fields, refuse_missing
from scaffold.generate.questions.names import header_name
from scaffold.generate.questions.questions import Given
from scaffold.generate.templates.template import PARTS, Role, Template

ADD = "add"
"""The question for parts, written KIND:NAME or as a mapping with answers of their own."""
KIND = "kind"
"""The key for the kind in such a mapping."""

_WORDS: Mapping[Role, str] = {
    Role.NODE: "the {kind} node {name}",
    Role.INTERFACE: "the {kind} {name}",
    Role.PROGRAM: "the program {name}",
}
_SECTIONS = ("topics", "services and actions", "transforms", "timers, parameters and states")
"""Headings of nodes, the most common first."""
_MAX_NAMED = 3
"""The maximum number of parts listed one by one."""


class Request(NamedTuple):
    """A part that the user requests."""

    template: Template
    given: Mapping[str, Given]
    """Answers for this part alone."""
    origin: str

    @property
    def name(self) -> str:
        """The name as given, or the template's default."""
        asked = self.template.name_question
        if asked in self.given:
            return str(self.given[asked].value)
        return next(
            str(question.default) for question in self.template.questions if question.name == asked
        )


class Part(NamedTuple):
    """A part with all its questions answered."""

    template: Template
    answers: Mapping[str, Any]

    @property
    def name(self) -> str:
        """The name of the node, the interface or the program."""
        return str(self.answers[self.template.name_question])


def requests(
    wanted: Sequence[Mapping[str, Any]], origin: str, templates: Mapping[str, Template]
) -> list[Request]:
    """Return the parts in the answer to the question ``add``.

    Args:
        wanted: A mapping for each part with ``kind``, and answers to questions of that kind;
            ``name`` is short for ``node_name``, ``interface_name`` or ``program_name``.
        origin: Where the user wrote it.
        templates: All templates.

    Raises:
        InputError: there is no such kind, or it does not have a question that is answered.
    """
    return [_request(entry, origin, templates) for entry in wanted]


def kinds(templates: Mapping[str, Template]) -> list[str]:
    """Return the kinds of parts: nodes first, each role in alphabetical order."""
    return [
        name
        for role in PARTS
        for name, template in sorted(templates.items())
        if template.role is role
    ]


def sections(templates: Mapping[str, Template]) -> dict[str, list[str]]:
    """Return the templates that can be added to a package, by heading."""
    result: dict[str, list[str]] = {}
    for role in (*PARTS, Role.EXTRA):
        own = [item for _, item in sorted(templates.items()) if item.role is role]
        for template in sorted(own, key=lambda item: _order(item.section)):
            result.setdefault(template.section, []).append(template.name)
    return result


def _order(section: str) -> tuple[int, str]:
    """Sort the built-in sections first, those of users after them."""
    at = _SECTIONS.index(section) if section in _SECTIONS else len(_SECTIONS)
    return at, section


def addable(templates: Mapping[str, Template]) -> list[str]:
    """Return the templates that can be added to a package: kinds of parts, and extras."""
    extras = [name for name, item in sorted(templates.items()) if item.role is Role.EXTRA]
    return [*kinds(templates), *extras]


def refuse_impossible(
    parts: Sequence[Part], package: str, build_type: str, messages: Sequence[str] = ()
) -> None:
    """Raise if the parts cannot be in one package of this build type.

    Args:
        parts: The parts of the package.
        package: Its name.
        build_type: Its build type.
        messages: The messages that it has already.

    Raises:
        InputError: with what to do instead.
    """
    roles = {part.template.role for part in parts}
    if Role.NODE in roles and Role.INTERFACE in roles:
        raise InputError(
            "interfaces and Python nodes cannot be in one package: both would install a Python "
            f"package {package!r}; put the interfaces into one of their own, such as "
            f"{package}_interfaces"
        )
    for part in parts:
        refuse_build_type(part.template, build_type)
        _refuse_one_frame_twice(part)
    own = [part.name for part in parts if part.template.definition == "msg"]
    for part in parts:
        for answer in part.answers.values():
            if isinstance(answer, Fields):
                refuse_missing(answer, [*messages, *own])
    _refuse_endless([part for part in parts if part.template.definition == "msg"])
    names: dict[str, Part] = {}
    for part in parts:
        other = names.setdefault(part.name, part)
        if other is not part:
            raise InputError(f"the package has two parts named {part.name!r}")
    _refuse_alike([part for part in parts if part.template.role is Role.INTERFACE])


def _refuse_one_frame_twice(part: Part) -> None:
    """Raise if a node would look up the transform of a frame to itself."""
    names: dict[str, str] = {}
    for question in part.template.questions:
        if question.type == "frame":
            frame = str(part.answers[question.name])
            other = names.setdefault(frame, question.name)
            if other != question.name:
                raise InputError(
                    f"{part.name}: {other} and {question.name} are both {frame!r}, and tf2 has "
                    "no transform from a frame to itself; choose different frames"
                )


def _refuse_endless(messages: Sequence[Part]) -> None:
    """Raise if a message contains itself, directly or through others."""
    held = {
        part.name: {
            name
            for answer in part.answers.values()
            if isinstance(answer, Fields)
            for name in answer.own_types
        }
        for part in messages
    }
    for name, types in held.items():
        pending, reached = [name], set[str]()
        while pending:
            inner = held.get(pending.pop(), set()) - reached
            reached |= inner
            pending += inner
        if name in reached:
            way = "" if name in types else ", inside another one"
            raise InputError(f"the message {name!r} would contain itself{way}")


def _refuse_alike(interfaces: Sequence[Part]) -> None:
    """Raise if the generated files of two interfaces have equal names."""
    headers: dict[tuple[str, str], str] = {}
    for part in interfaces:
        header = header_name(part.name)
        other = headers.setdefault((part.template.definition, header), part.name)
        if other != part.name:
            raise InputError(
                f"{other!r} and {part.name!r} are too similar: both would generate {header}.hpp"
            )


def refuse_build_type(template: Template, build_type: str) -> None:
    """Raise if a template is not for a build type.

    Raises:
        InputError: with those that it is for.
    """
    if template.build_types and build_type not in template.build_types:
        wanted = " or ".join(template.build_types)
        raise InputError(f"{template.name} needs the build type {wanted}, not {build_type}")


def contents(requested: Iterable[Request]) -> str:
    """Describe the parts in words, such as "the publisher node talker and the message Status"."""
    words = [
        _WORDS[item.template.role].format(kind=item.template.name.replace("_", " "), name=item.name)
        for item in requested
    ]
    if len(words) > _MAX_NAMED:
        words = [*words[: _MAX_NAMED - 1], f"{len(words) - _MAX_NAMED + 1} more"]
    return " and ".join(filter(None, [", ".join(words[:-1]), *words[-1:]]))


def _request(entry: Mapping[str, Any], origin: str, templates: Mapping[str, Template]) -> Request:
    from scaffold.generate.questions.questions import choose

    kind = choose(str(entry.get(KIND)), kinds(templates), origin)
    template = templates[kind]
    names = {question.name for question in template.questions}
    given: dict[str, Given] = {}
    for key, value in entry.items():
        name = template.name_question if key == "name" else key.replace("-", "_")
        if key != KIND and name not in names:
            raise InputError(
                f"{origin}: {kind} has no option {key!r}; it has {', '.join(sorted(names))}"
            )
        if key != KIND and value is not None:
            given[name] = Given(value, f"{origin}: {kind}" if key == "name" else f"{origin}: {key}")
    return Request(template, given, origin)
