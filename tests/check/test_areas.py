"""No rule of an area that is called silent has anything to say."""

from __future__ import annotations

import pytest

from scaffold.check import registry, runner
from scaffold.check.areas import silent
from scaffold.check.rule import Example, Rule
from scaffold.configuration import content
from scaffold.files.tree import MemoryTree
from scaffold.generate import draft, examples
from scaffold.generate.questions.defaults import User
from scaffold.generate.questions.questions import Given
from scaffold.generate.templates import template
from scaffold.model.package import Package

RULES = registry.load(content.roots("rules"))
REJECTED = [(rule, one) for rule in RULES for one in rule.examples if one.reports]
ROOTS = content.roots("templates")
TEMPLATES = template.load(ROOTS)
AREAS = {"setup_py", "launch", "parameters"}


def area(rule: type[Rule]) -> str:
    return rule.__module__.split(".")[-2]


@pytest.mark.parametrize(
    ("rule", "example"),
    [pytest.param(*one, id=f"{one[0].code}-{one[1].title}") for one in REJECTED],
)
def test_no_rejected_example_is_silent(rule: type[Rule], example: Example) -> None:
    assert area(rule) not in silent(Package.of(example.files))


def test_every_area_is_sometimes_silent() -> None:
    files = [one.files for rule in RULES for one in rule.examples]
    assert set().union(*(silent(Package.of(one)) for one in files)) == AREAS
    assert {area(rule) for rule in RULES} > AREAS


def test_where_something_is_suppressed_all_rules_run() -> None:
    assert silent(Package.of({"a.py": "import os\n"})) == AREAS
    assert silent(Package.of({"a.py": "import os  # noqa: LF001\n"})) == frozenset()


@pytest.mark.parametrize("name", TEMPLATES)
def test_the_rules_that_are_left_out_find_nothing_in_new_packages(name: str) -> None:
    user = {"maintainer_name": "Ada", "maintainer_email": "ada@example.com"}
    for example in examples.of(TEMPLATES[name], TEMPLATES):
        answers = {**user, **example.answers}
        given = {key: Given(value, key) for key, value in answers.items()}
        made = draft.draft(ROOTS, TEMPLATES, given, User("."))
        tree = MemoryTree(made.rendered.files, made.rendered.executable)
        areas = silent(Package(tree, directory=made.name))
        for rule in RULES:
            if area(rule) in areas:
                assert run(rule, Package(tree, directory=made.name)) == []


def run(rule: type[Rule], package: Package) -> list[object]:
    return list(runner.check(package, [rule()]))


def test_areas_can_be_left_out() -> None:
    some = registry.load(content.roots("rules"), without=AREAS)
    assert [rule.code for rule in some] == [rule.code for rule in RULES if area(rule) not in AREAS]
