"""The examples of templates: packages that must be right, and show what a template is for."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any, NamedTuple

from scaffold.generate.parts import ADD
from scaffold.generate.template import PARTS, Role, Template, of_role

PACKAGE = "example_package"
"""The name of a package whose example has none."""


class Example(NamedTuple):
    """Answers that make a package with a template in it."""

    template: str
    title: str
    answers: Mapping[str, Any]


def of(template: Template, templates: Mapping[str, Template]) -> Iterator[Example]:
    """Yield the examples of a template, for each build type that it is for.

    An example need not say what its template is: ``--add``, ``--build-type`` or ``--extras`` are
    completed.
    """
    for title, answers in template.examples.items():
        for build_type in of_role(templates, Role.BUILD_TYPE):
            own = _own(template, answers)
            whole = {"package": PACKAGE, "build_type": build_type, **own, **answers}
            if whole["build_type"] == build_type and _is_for(template, build_type):
                yield Example(template.name, f"{title}, {build_type}", whole)


def _own(template: Template, answers: Mapping[str, Any]) -> dict[str, Any]:
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
