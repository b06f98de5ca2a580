"""The examples of templates, which are tests and documentation."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from difflib import get_close_matches
from typing import TYPE_CHECKING, Any, NamedTuple

from scaffold.errors import ScaffoldError
from scaffold.generate import checking, draft
from scaffold.generate.draft import Draft
from scaffold.generate.parts import ADD, KIND
from scaffold.generate.questions.defaults import User
from scaffold.generate.questions.questions import Given
from scaffold.generate.templates.template import PARTS, Role, Template, of_role

if TYPE_CHECKING:
    from scaffold.check.rules.rule import Rule
    from scaffold.diagnostic import Diagnostic

PACKAGE = "example_package"
"""The package name of examples without one."""


class Example(NamedTuple):
    """Answers for a package that contains a template."""

    template: str
    title: str
    answers: Mapping[str, Any]


def of(template: Template, templates: Mapping[str, Template]) -> Iterator[Example]:
    """Yield the examples of a template, for each build type that it is for.

    The template itself need not be in an example: ``--add``, ``--build-type`` or ``--extras`` are
    completed.
    """
    for title, answers in template.examples.items():
        for build_type in of_role(templates, Role.BUILD_TYPE):
            own = _template_answer(template, answers)
            whole = {"package": PACKAGE, "build_type": build_type, **own, **answers}
            if whole["build_type"] == build_type and _is_for(template, build_type):
                yield Example(template.name, f"{title}, {build_type}", whole)


def _template_answer(template: Template, answers: Mapping[str, Any]) -> dict[str, Any]:
    if template.role is Role.NODE and ADD not in answers:
        return {"node_kind": template.name}
    if template.role in PARTS and ADD not in answers:
        return {ADD: [template.name]}
    if template.role is Role.EXTRA:
        return {"extras": [template.name]}
    return {}


def _is_for(template: Template, build_type: str) -> bool:
    if template.role is Role.BUILD_TYPE:
        return template.name == build_type
    return not template.build_types or build_type in template.build_types


class Tried(NamedTuple):
    """An example and its result."""

    example: Example
    made: Draft | None
    """The package; ``None`` if it cannot be rendered."""
    defects: tuple[str, ...]
    """The defects, one line each."""


def check(
    names: Iterable[str],
    roots: Sequence[str],
    templates: Mapping[str, Template],
    rules: Sequence[type[Rule]],
) -> Iterator[Tried]:
    """Render the examples of some templates and check the packages with every rule."""
    for name in names:
        for example in of(templates[name], templates):
            yield _try_example(example, roots, templates, rules)


def _try_example(
    example: Example,
    roots: Sequence[str],
    templates: Mapping[str, Template],
    rules: Sequence[type[Rule]],
) -> Tried:
    mistakes = (*_unknown(example, templates), *_without_template(example, templates))
    if mistakes:
        return Tried(example, None, mistakes)
    answers = {"maintainer_name": "Ada Lovelace", "maintainer_email": "ada@example.com"}
    origin = f"example {example.title!r} of {example.template}"
    given = {
        name: Given(value, f"{origin}: {name}")
        for name, value in {**answers, **example.answers}.items()
    }
    try:
        made = draft.draft(roots, templates, given, User("."))
    except ScaffoldError as error:
        return Tried(example, None, (str(error),))
    return Tried(example, made, tuple(map(_line, checking.defects(made, rules))))


def _unknown(example: Example, templates: Mapping[str, Template]) -> Iterator[str]:
    """Yield a line for each answer of an example to an unknown question."""
    asked = {question.name for template in templates.values() for question in template.questions}
    for name in example.answers:
        if name not in asked:
            closest = get_close_matches(name, asked, n=1)
            hint = f"; did you mean {closest[0]!r}?" if closest else ""
            yield f"example {example.title!r}: no template has a question {name!r}{hint}"


def _without_template(example: Example, templates: Mapping[str, Template]) -> Iterator[str]:
    """Yield a line if an example does not use its template."""
    parts = example.answers.get(ADD)
    if templates[example.template].role not in PARTS or not isinstance(parts, list):
        return
    kinds = [
        str(part.get(KIND)) if isinstance(part, Mapping) else str(part).partition(":")[0]
        for part in parts
    ]
    if example.template not in {*kinds, example.answers.get("node_kind")}:
        listed = ", ".join(dict.fromkeys(kinds))
        yield f"example {example.title!r}: has no {example.template}, but {listed}"


def _line(defect: Diagnostic) -> str:
    at = defect.location
    return f"{at.path}:{at.line}:{at.column}: {defect.code} {defect.message}"
