"""Limits of user templates: no access to other files, bounded time and memory."""

from __future__ import annotations

import os
import signal
from datetime import date
from pathlib import Path

import pytest

from scaffold.check.rules import registry
from scaffold.cli.main import main
from scaffold.configuration import content
from scaffold.errors import ContentError
from scaffold.generate import examples
from scaffold.generate.draft import draft
from scaffold.generate.questions.defaults import User
from scaffold.generate.questions.questions import Given
from scaffold.generate.templates import foreign, loading

MANIFEST = """summary: A lamp
questions:
  place: { default: "PLACE", help: where it is }
examples:
  plain: { package: lamp_package }
"""


@pytest.fixture
def lamp(tmp_path: Path) -> Path:
    """Return the directory of an empty template."""
    directory = tmp_path / "templates" / "extras" / "lamp"
    directory.mkdir(parents=True)
    (directory / "template.yaml").write_text(MANIFEST)
    (tmp_path / "secret").write_text("secret\n")
    return directory


def defect(lamp: Path) -> str:
    """Return the only defect of the first example of the template."""
    roots = content.roots("templates", (str(lamp.parents[2]),))
    rules = registry.load(content.roots("rules"))
    first = next(iter(examples.check(["lamp"], roots, loading.load(roots), rules)))
    assert len(first.defects) == 1
    assert len(first.defects[0].splitlines()) == 1
    return first.defects[0]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("{{ ''.__class__.__mro__ }}", "lamp.txt.jinja:2: SecurityError: access to attribute"),
        ("{{ cycler.__init__.__globals__ }}", "lamp.txt.jinja:2: SecurityError: access"),
        ("{% include '../secret' %}", "no template has the file '../secret'"),
        ("{% include 'lamp/../../secret' %}", "no template has the file 'lamp/../../secret'"),
        ("{% include '/etc/passwd' %}", "no template has the file '/etc/passwd'"),
        ("{% for i in range(10 ** 9) %}{% endfor %}", "more than 1000000 iterations of loops"),
        (
            "{% for i in range(9999) %}{% for j in range(9999) %}{% endfor %}{% endfor %}",
            "more than 1000000 iterations of loops",
        ),
        ("{{ 10 ** (10 ** 9) }}", "a power is too large"),
        ("{{ 'a' * 10 ** 9 }}", "a repetition is too large"),
        ("{{ 10 ** 9 * [1] }}", "a repetition is too large"),
        ("{% macro f() %}{{ f() }}{% endmacro %}{{ f() }}", "RecursionError"),
        ("{% include 'lamp/lamp.txt.jinja' %}", "RecursionError"),
        ("{{ nothing }}", "lamp.txt.jinja:2: 'nothing' is undefined"),
        ("{{ 1 / 0 }}", "lamp.txt.jinja:2: ZeroDivisionError"),
    ],
)
def test_unsafe_template_expressions_are_rejected(lamp: Path, text: str, message: str) -> None:
    (lamp / "lamp.txt.jinja").write_text(f"first line\n{text}\n")
    assert message in defect(lamp)


@pytest.mark.parametrize("place", ["../x", "../../x", "/x", "a/../../x", "a//b", ".", ""])
def test_paths_out_of_the_package_are_rejected(lamp: Path, place: str) -> None:
    (lamp / "template.yaml").write_text(MANIFEST.replace("PLACE", place or "{{ '' }}"))
    (lamp / "{{ place }}.jinja").write_text("text\n")
    assert "is not a path inside the package" in defect(lamp) or "must not be empty" in defect(lamp)


def test_symlinks_out_of_the_templates_are_rejected(lamp: Path) -> None:
    (lamp / "lamp.txt.jinja").symlink_to(lamp.parents[2] / "secret")
    assert "a link to" in defect(lamp)


def test_directory_symlinks_out_of_the_templates_are_rejected(lamp: Path) -> None:
    (lamp / "docs").symlink_to(lamp.parents[2])
    assert "a link to" in defect(lamp)


def test_symlinks_between_templates_are_followed(lamp: Path) -> None:
    other = lamp.parent / "_shared"
    other.mkdir()
    (other / "lamp.txt").write_text("{{ nothing }}\n")
    (lamp / "lamp.txt.jinja").symlink_to("../_shared/lamp.txt")
    assert "'nothing' is undefined" in defect(lamp)


# -- bounds on memory and time

LONG = "{% set xs = lipsum(n=200, html=false) %}"
GREEDY = {
    "ljust": "{{ 'a'.ljust(10 ** 10) }}",
    "center": "{{ 'a'.center(10 ** 10) }}",
    "the filter center": "{{ 'a' | center(10 ** 10) }}",
    "a width of format": "{{ '{:>9999999999}'.format('a') }}",
    "a width of %": "{{ '%9999999999d' % 1 }}",
    "the filter format": "{{ '%9999999999d' | format(1) }}",
    "zfill": "{{ 'a'.zfill(10 ** 10) }}",
    "indent": "{{ ('a\\n' * 90000) | indent(10 ** 6) }}",
    "replace": "{{ ('a' * 10 ** 6).replace('a', 'b' * 10 ** 6) }}",
    "join": "{{ (('a' * 10 ** 6) | list) | join('b' * 10 ** 6) }}",
    "long output": "{% for i in range(10) %}{{ 'a' * 10 ** 6 }}{% endfor %}",
    "doubling": "{% set ns = namespace(x='aaaa') %}{% for i in range(60) %}"
    "{% set ns.x = ns.x + ns.x %}{% endfor %}",
}
"""Templates that ask for gigabytes."""


@pytest.mark.parametrize("name", GREEDY)
def test_memory_is_limited(name: str, lamp: Path) -> None:
    (lamp / "lamp.txt.jinja").write_text(f"first line\n{GREEDY[name]}\n")
    message = defect(lamp)
    assert "lamp.txt.jinja" in message
    assert "too much memory" in message or "renders more than" in message or "Error" in message


@pytest.mark.parametrize(
    "text",
    [
        f"{LONG}{{% for a in xs %}}{{% for b in xs %}}{{% endfor %}}{{% endfor %}}",
        "{% set xs = 'a' * 99999 %}{% for a in xs %}{% for b in xs %}{% endfor %}{% endfor %}",
    ],
)
def test_time_is_limited(text: str, lamp: Path) -> None:
    (lamp / "lamp.txt.jinja").write_text(text)
    assert "lamp.txt.jinja: takes more than 5 s of CPU time" in defect(lamp)


def test_conditions_and_defaults_are_limited(lamp: Path) -> None:
    (lamp / "lamp.txt.jinja").write_text("text\n")
    (lamp / "template.yaml").write_text(MANIFEST.replace("PLACE", "{{ 'a'.ljust(10 ** 10) }}"))
    assert "too much memory" in defect(lamp)


def test_exceeded_limit_is_one_error_line_and_writes_nothing(
    lamp: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (lamp / "lamp.txt.jinja").write_text("{{ 'a'.ljust(10 ** 10) }}\n")
    where = tmp_path / "made"
    where.mkdir()
    words = ["new", "talker", "--extras", "lamp", "--content", str(tmp_path)]

    assert main([*words, "--destination-directory", str(where)]) == 2

    error = capsys.readouterr().err
    assert error.startswith("ros2-scaffold: error: template 'lamp/lamp.txt.jinja', ")
    assert error.count("\n") == 1
    assert list(where.iterdir()) == []


def test_killed_renderer_is_one_error_line(lamp: Path) -> None:
    (lamp / "lamp.txt.jinja").write_text("text\n")
    roots = content.roots("templates", (str(lamp.parents[2]),))
    engine = foreign.ForeignEngine(roots, {"lamp": [str(lamp)]}, is_tutorial=False)
    assert engine.text("{{ 1 + 1 }}", {}) == "2"
    process = engine._process  # noqa: SLF001  what a kernel out of memory does
    assert process is not None
    os.kill(process.pid, signal.SIGSEGV)
    process.wait()

    with pytest.raises(ContentError, match=r"lamp.txt.jinja: crashes the process .*\(SIGSEGV\)$"):
        engine.file("lamp/lamp.txt.jinja", {})
    assert engine.file("lamp/lamp.txt.jinja", {}) == "text\n"


def test_named_pipe_as_template_is_rejected(lamp: Path) -> None:
    os.mkfifo(lamp / "lamp.txt.jinja")
    assert "lamp.txt.jinja: is not a file" in defect(lamp)


def test_sandboxed_rendering_equals_direct_rendering(tmp_path: Path) -> None:
    (tmp_path / "templates").mkdir()
    own = content.roots("templates")
    templates = loading.load(own)
    answers = {"maintainer_name": "Ada Lovelace", "maintainer_email": "ada@example.com"}
    for item in templates.values():
        for example in list(examples.of(item, templates))[:1]:
            given = {
                name: Given(value, name) for name, value in {**answers, **example.answers}.items()
            }
            here, there = (
                draft(roots, templates, given, User("."), date(2025, 1, 1))
                for roots in (own, content.roots("templates", (str(tmp_path),)))
            )
            assert here == there._replace(roots=here.roots)
