"""Errors in user templates: one message with file, line and reason."""

from __future__ import annotations

from pathlib import Path

import pytest

from scaffold.cli.exit_codes import USAGE_ERROR
from scaffold.cli.main import main

MANIFEST = """\
summary: A beacon
questions:
  node_name: { type: node, default: beacon, help: name of the node }
  period: { type: rate, default: 1.0, help: flashes per second }
depends:
  exec: [rclpy]
executable: ["{{ package }}/{{ node.module }}.py"]
"""
MODULE = '#!/usr/bin/env python3\n{{ header }}\n\n"""Flash."""\n'
TEST = '{{ header }}\n\n"""Look at the beacon."""\n'
README = "{% macro run(node) %}Run it.{% endmacro %}\n{% macro look(node) %}See it.{% endmacro %}\n"
PATH = "{{ package }}/{{ node.module }}.py.jinja"


@pytest.fixture
def beacon(tmp_path: Path) -> Path:
    """Return the directory of a user template."""
    directory = tmp_path / "templates" / "nodes" / "beacon"
    files = {
        "template.yaml": MANIFEST,
        PATH: MODULE,
        "test/test_{{ node.module }}.py.jinja": TEST,
        "_readme.md.jinja": README,
    }
    for path, text in files.items():
        (directory / path).parent.mkdir(parents=True, exist_ok=True)
        (directory / path).write_text(text)
    return directory


def new(beacon: Path) -> int:
    """Create a package with one node of the template."""
    words = ["new", "lighthouse", "--node-kind", "beacon", "--content", str(beacon.parents[2])]
    return main([*words, "--destination-directory", str(beacon.parents[2])])


def test_correct_template_is_rendered(beacon: Path) -> None:
    assert new(beacon) == 0


@pytest.mark.parametrize(
    ("path", "text", "line"),
    [
        (PATH, "{{ node.colour }}", ", BEACON/PATH:1: 'dict object' has no attribute 'colour'"),
        (PATH, "{% if %}", ", BEACON/PATH:1: Expected an expression, got 'end of statement block'"),
        (PATH, "{{ 1 / 0 }}", ", BEACON/PATH:1: ZeroDivisionError: division by zero"),
        (PATH, "\udcff", "error: BEACON/PATH: 'utf-8' codec can't decode byte 0xff"),
        (
            "_readme.md.jinja",
            README.splitlines()[0],
            ": beacon/_readme.md.jinja has no macro 'look'",
        ),
        (
            "template.yaml",
            MANIFEST.replace("rclpy", '"{{ library }}"'),
            "error: BEACON/template.yaml: '{{ library }}': 'library' is undefined",
        ),
        (
            "template.yaml",
            f'{MANIFEST}include: {{ "*": "node.colour ==" }}\n',
            "error: BEACON/template.yaml: 'node.colour ==': unexpected 'end of statement block'",
        ),
        (
            "template.yaml",
            MANIFEST.replace("1.0", "often"),
            "error: the default of 'period': 'often' is not a rate in hertz",
        ),
    ],
)
def test_template_error_is_one_line(
    beacon: Path, capsys: pytest.CaptureFixture[str], path: str, text: str, line: str
) -> None:
    (beacon / path).write_text(text, errors="surrogateescape")
    assert new(beacon) == USAGE_ERROR
    errors = capsys.readouterr().err
    assert line.replace("BEACON", str(beacon)).replace("PATH", PATH) in errors
    assert errors.count("\n") == 1
    assert not (beacon.parents[2] / "lighthouse").exists()
