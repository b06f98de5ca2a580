"""Templates that are translated to Python give what Jinja gives."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import pytest

import scaffold
from scaffold import cache, content
from scaffold.errors import ContentError
from scaffold.generate import draft, examples, filters, template
from scaffold.generate.defaults import User
from scaffold.generate.questions import Given
from scaffold.generate.render import Renderer

ROOTS = content.roots("templates")
TEMPLATES = template.load(ROOTS)
EXAMPLES = [one for layer in TEMPLATES.values() for one in examples.of(layer, TEMPLATES)]


@pytest.fixture(autouse=True)
def _own_cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    monkeypatch.delenv(cache.SWITCH, raising=False)


@pytest.fixture
def compared(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """Let every text be rendered both ways; return the names of what was."""
    seen: list[str] = []

    def file(self: Renderer, name: str, context: Mapping[str, Any]) -> str:
        is_xml = name.endswith(".xml.jinja")
        shown: Callable[[Any], str] = filters.xml if is_xml else str
        by_program = self.programs.render(name, context, shown)
        assert by_program == self.jinja.file(name, context, is_xml=is_xml), name
        seen.append(name)
        return by_program

    def text(self: Renderer, source: str, context: Mapping[str, Any]) -> str:
        by_program = self.programs.render(self.programs.named(source), context, str)
        assert by_program == self.jinja.text(source, context), source
        seen.append(source)
        return by_program

    monkeypatch.setattr(Renderer, "file", file)
    monkeypatch.setattr(Renderer, "text", text)
    return seen


@pytest.mark.parametrize("comments", ["brief", "tutorial"])
@pytest.mark.parametrize("example", EXAMPLES, ids=lambda one: f"{one.template}-{one.title}")
def test_every_example(example: examples.Example, comments: str, compared: list[str]) -> None:
    answers = {
        "maintainer_name": "Ada & Søn <x>",
        "maintainer_email": "ada@example.com",
        "description": "Shows *stars* & <tags>, a_b and 'quotes'",
        **example.answers,
        "comments": comments,
    }
    given = {name: Given(value, name) for name, value in answers.items()}
    draft.draft(ROOTS, TEMPLATES, given, User("."))
    assert "package/package.xml.jinja" in compared


PARTS = {
    "nothing": "",
    "if": "{% if one %}a{% elif two %}b{% else %}c{% endif %}",
    "loop": "{% for x in many %}{{ loop.index }}{{ x }}{{ ',' if not loop.last else '.' }}"
    "{% endfor %}",
    "loop with a condition": "{% for x in many if x != 2 %}{{ loop.first }}{{ x }}{% else %}-"
    "{% endfor %}",
    "loop over nothing": "{% for x in [] %}{{ x }}{% else %}none{% endfor %}",
    "loop over pairs": "{% for key, value in pairs %}{{ key }}={{ value }} {% endfor %}",
    "a loop keeps its variables": "{% set x = 0 %}{% for y in many %}{% set x = y %}{{ x }}"
    "{% endfor %}{{ x }}",
    "loops in loops": "{% for x in many %}{% for y in many %}{{ loop.index0 }}{% endfor %}"
    "{{ loop.length }}{% endfor %}",
    "macro": "{% macro f(a, b='x', c=a) %}{{ a }}{{ b }}{{ c }}{% endmacro %}"
    "{{ f(1) }}{{ f(1, c=3) }}{{ f('p', 'q', 'r') }}",
    "a macro sees what is set": "{% set x = 1 %}{% macro f() %}{{ x }}{% endmacro %}"
    "{% set x = 2 %}{{ f() }}{% for x in many %}{{ f() }}{% endfor %}",
    "macro in macro": "{% macro f(a) %}<{{ a }}>{% endmacro %}"
    "{% macro g(b) %}{{ f(b) ~ f(a=b) }}{% endmacro %}{{ g('&') }}",
    "filter block": "{% filter slashes %}# {{ word }}\n{% endfilter %}",
    "indent": "{% filter indent(2) %}a\n\nb\n  c\n{% endfilter %}|{{ 'x\ny' | indent }}",
    "filters": "{{ many | join('+') }}{{ word | literal }}{{ many | sort | list | length }}"
    "{{ [many | min, many | max] }}{{ ['b', 'A'] | sort }}{{ word | replace('w', 'v') | trim }}",
    "filters with attributes": "{{ things | selectattr('on') | list | length }}"
    "{{ things | rejectattr('on') | list }}{{ many | reject('in', [1, 2]) | list }}",
    "arithmetic": "{{ 1 + 2 * 3 - 1 }}{{ 'a' ~ 1 ~ none }}{{ [1] + [2] }}{{ not one }}",
    "comparisons": "{{ 1 < 2 <= 2 }}{{ 3 in many }}{{ 3 not in many }}{{ one == two or 5 }}",
    "attribute or item": "{{ thing.on }}{{ thing['on'] }}{{ thing.name }}{{ thing.get('x', 4) }}",
    "tuples and dictionaries": "{{ (1, 2) }}{{ {'a': 1} }}{{ dict(a=1) }}{{ () }}{{ many[0] }}",
    "defined": "{{ word is defined }}{{ nothing is defined }}{{ 1 if nothing is defined else 2 }}"
    "{{ thing.on is defined }}{{ thing['off'] is defined }}{{ word.on is not defined }}",
    "numbers and texts": "{{ 1.5 }}{{ true }}{{ none }}{{ 'it\\'s' }}{{ \"\\n\" }}",
    "no else": "{{ 'x' if one }}{{ 'x' if nought }}{{ ('x' if nought) | length }}"
    "{% for x in (many if nought) %}x{% endfor %}{% if ('x' if nought) %}x{% endif %}",
    "range": "{% for i in range(3) %}{{ i }}{% endfor %}",
    "white space": "a\n  {% if one %}\n  b\n  {%- endif %}\n{# no #}\nc\n",
}
LEFT_TO_JINJA = {
    "a filter": "{{ word | upper }}",
    "a filter with an attribute": "{{ things | map(attribute='on') | list }}",
    "a test": "{{ 1 is odd }}",
    "an item of a text": "{{ word.0 }}{{ word[0:2] }}",
    "call": "{% macro f() %}{{ caller() }}{% endmacro %}{% call f() %}x{% endcall %}",
    "more arguments": "{% macro f() %}{{ varargs | length }}{% endmacro %}{{ f(1, 2) }}",
    "a block": "{% block x %}y{% endblock %}",
    "set with a body": "{% set x %}y{% endset %}{{ x }}",
    "with": "{% with x = 1 %}{{ x }}{% endwith %}",
    "recursion": "{% for x in many recursive %}{{ x }}{% endfor %}",
    "a loop that compares": "{% for x in many %}{{ loop.changed(x) }}{% endfor %}",
    "division": "{{ 7 // 2 }}{{ 7 % 4 }}{{ -1 }}",
    "a default": "{{ nothing | default('x') }}",
}
REFUSED = {
    "unknown": "{{ nothing }}",
    "unknown attribute": "{{ thing.other }}",
    "insides": "{{ word.__class__ }}",
    "no number": "{{ word + 1 }}",
    "argument missing": "{% macro f(a) %}{{ a }}{% endmacro %}{{ f() }}",
    "argument unknown": "{% macro f(a) %}{{ a }}{% endmacro %}{{ f(1, b=2) }}",
    "no module": "{% from 'package/none.jinja' import x %}",
    "syntax": "{% if %}",
    "without end": "{% macro f() %}{{ f() }}{% endmacro %}{{ f() }}",
}
CONTEXT = {
    "one": True,
    "two": False,
    "nought": 0,
    "word": "word",
    "many": [3, 1, 2],
    "pairs": [("a", 1), ("b", 2)],
    "thing": {"on": 1, "name": "lamp"},
    "things": [{"on": 1}, {"on": 0}],
}


def renderer() -> Renderer:
    return Renderer(ROOTS, TEMPLATES, is_tutorial=False)


@pytest.mark.parametrize("shown", [str, filters.xml])
@pytest.mark.parametrize("text", PARTS.values(), ids=PARTS)
def test_what_is_translated(text: str, shown: Callable[[Any], str]) -> None:
    one = renderer()
    found = one.programs.render(one.programs.named(text), CONTEXT, shown)
    jinja = one.jinja.xml if shown is filters.xml else one.jinja.plain
    assert found == jinja.from_string(text).render(CONTEXT)


@pytest.mark.parametrize("text", LEFT_TO_JINJA.values(), ids=LEFT_TO_JINJA)
def test_what_is_left_to_jinja(text: str) -> None:
    one = renderer()
    assert one.programs.render(one.programs.named(text), CONTEXT, str) is None
    assert one.text(text, CONTEXT) == one.jinja.plain.from_string(text).render(CONTEXT)


@pytest.mark.parametrize("text", REFUSED.values(), ids=REFUSED)
def test_what_is_refused(text: str) -> None:
    with pytest.raises(ContentError, match=r"^template "):
        renderer().text(text, CONTEXT)


def test_templates_of_the_user_stay_in_the_sandbox(tmp_path: Path) -> None:
    own = tmp_path / "templates"
    own.mkdir()
    roots = [*ROOTS, str(own)]
    one = Renderer(roots, template.load(roots), is_tutorial=False)
    assert one.text("{{ 1 + 1 }}", {}) == "2"
    assert "programs" not in vars(one)


def test_a_change_is_seen(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    root = tmp_path / "templates"
    (root / "_shared").mkdir(parents=True)
    file = root / "_shared" / "x.jinja"
    monkeypatch.setattr(content, "roots", lambda _: [str(root)])
    for text in ("a{{ 1 }}", "b{{ 1 }}", "c{{ 1"):
        file.unlink(missing_ok=True)
        file.write_text(text)
        one = Renderer([str(root)], {}, is_tutorial=False)
        if text.endswith("}}"):
            for _ in range(2):
                assert one.file("_shared/x.jinja", {}) == text[0] + "1"
        else:
            with pytest.raises(ContentError, match=r"_shared/x\.jinja"):
                one.file("_shared/x.jinja", {})
    assert "jinja" in vars(one)


def test_a_damaged_cache_is_ignored(tmp_path: Path) -> None:
    assert renderer().text("{{ 1 }}", {}) == "1"
    (kept,) = (tmp_path / "cache" / "ros2-scaffold" / "programs").iterdir()
    whole = kept.read_bytes()
    for at in range(0, len(whole), 37):
        kept.write_bytes(whole[:at] + bytes([whole[at] ^ 0x41]) + whole[at + 1 :])
        assert renderer().text("{{ 1 }}", {}) == "1"
        assert kept.read_bytes() == whole


@pytest.mark.parametrize("arguments", [[], ["--build-type", "ament_python", "--extras", "launch"]])
def test_new_needs_no_jinja(tmp_path: Path, arguments: list[str]) -> None:
    code = (
        "import sys\nfrom scaffold.cli.main import main\n"
        "status = main(sys.argv[1:])\nprint('jinja2' in sys.modules)\nsys.exit(status)\n"
    )
    user = ["--maintainer-name", "Ada", "--maintainer-email", "ada@example.com"]
    for name, expected in (("first", "True"), ("second", "False")):
        done = subprocess.run(
            [sys.executable, "-c", code, "new", name, *user, *arguments],
            cwd=tmp_path,
            env={**os.environ, "PYTHONPATH": str(Path(scaffold.__file__).parents[1])},
            capture_output=True,
            text=True,
            check=True,
        )
        assert done.stdout.splitlines()[-1] == expected
