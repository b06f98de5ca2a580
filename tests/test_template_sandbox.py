"""What templates of a team may not do: look outside, write outside, run without end."""

from __future__ import annotations

from pathlib import Path

import pytest

from scaffold import content
from scaffold.check import registry
from scaffold.generate import examples, template

MANIFEST = """summary: A lamp
role: extra
questions:
  place: { default: "PLACE", help: where it is }
examples:
  plain: { package: lamp_package }
"""


@pytest.fixture
def lamp(tmp_path: Path) -> Path:
    """Return the directory of a template that does nothing yet."""
    directory = tmp_path / "templates" / "lamp"
    directory.mkdir(parents=True)
    (directory / "template.yaml").write_text(MANIFEST)
    (tmp_path / "secret").write_text("secret\n")
    return directory


def said(lamp: Path) -> str:
    """Return what is wrong with the first example of the template."""
    roots = content.roots("templates", (str(lamp.parents[1]),))
    rules = registry.load(content.roots("rules"))
    first = next(iter(examples.check(["lamp"], roots, template.load(roots), rules)))
    assert len(first.defects) == 1
    assert len(first.defects[0].splitlines()) == 1
    return first.defects[0]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("{{ ''.__class__.__mro__ }}", "lamp.txt.jinja:2: SecurityError: access to attribute"),
        ("{{ cycler.__init__.__globals__ }}", "lamp.txt.jinja:2: SecurityError: access"),
        ("{% include '../secret' %}", "TemplateNotFound: ../secret"),
        ("{% include 'lamp/../../secret' %}", "TemplateNotFound: lamp/../../secret"),
        ("{% include '/etc/passwd' %}", "TemplateNotFound: /etc/passwd"),
        ("{% for i in range(10 ** 9) %}{% endfor %}", "more than 1000000 rounds of loops"),
        (
            "{% for i in range(9999) %}{% for j in range(9999) %}{% endfor %}{% endfor %}",
            "more than 1000000 rounds of loops",
        ),
        ("{{ 10 ** (10 ** 9) }}", "a power is too large"),
        ("{{ 'a' * 10 ** 9 }}", "too much is repeated"),
        ("{{ 10 ** 9 * [1] }}", "too much is repeated"),
        ("{% macro f() %}{{ f() }}{% endmacro %}{{ f() }}", "RecursionError"),
        ("{% include 'lamp/lamp.txt.jinja' %}", "RecursionError"),
        ("{{ nothing }}", "lamp.txt.jinja:2: UndefinedError: 'nothing' is undefined"),
        ("{{ 1 / 0 }}", "lamp.txt.jinja:2: ZeroDivisionError"),
    ],
)
def test_files_that_are_refused(lamp: Path, text: str, message: str) -> None:
    (lamp / "lamp.txt.jinja").write_text(f"first line\n{text}\n")
    assert message in said(lamp)


@pytest.mark.parametrize("place", ["../x", "../../x", "/x", "a/../../x", "a//b", ".", ""])
def test_paths_that_leave_the_package(lamp: Path, place: str) -> None:
    (lamp / "template.yaml").write_text(MANIFEST.replace("PLACE", place or "{{ '' }}"))
    (lamp / "{{ place }}.jinja").write_text("text\n")
    assert "is not a path in the package" in said(lamp) or "must not be empty" in said(lamp)


def test_links_out_of_the_templates(lamp: Path) -> None:
    (lamp / "lamp.txt.jinja").symlink_to(lamp.parents[1] / "secret")
    assert "a link to" in said(lamp)


def test_links_to_directories_out_of_the_templates(lamp: Path) -> None:
    (lamp / "docs").symlink_to(lamp.parents[1])
    assert "a link to" in said(lamp)


def test_links_between_templates(lamp: Path) -> None:
    other = lamp.parent / "_shared"
    other.mkdir()
    (other / "lamp.txt").write_text("{{ nothing }}\n")
    (lamp / "lamp.txt.jinja").symlink_to("../_shared/lamp.txt")
    assert "'nothing' is undefined" in said(lamp)
