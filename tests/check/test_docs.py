"""The pages of the rules are made from the rules (`make docs`); links and paths lead somewhere."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import pytest

from scaffold.ament.codes import STYLE
from scaffold.check.rules import docs, registry
from scaffold.check.session import all_rules
from scaffold.configuration import content

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

ROOT = Path(__file__).parents[2]
PAGES = [
    str(path.relative_to(ROOT))
    for path in (*ROOT.glob("*.md"), *ROOT.glob("docs/**/*.md"), *ROOT.glob("changelog.d/*.md"))
    if not re.fullmatch(r"[A-Z]{1,2}\d+", path.stem)
]
"""Those that are written by hand, and the table of the rules."""
RULES = all_rules(registry.load(content.roots("rules")))


def test_pages_are_current(tmp_path: Path) -> None:
    docs.write(str(tmp_path), RULES)
    made = {path.name: path.read_text() for path in tmp_path.iterdir()}
    kept = {path.name: path.read_text() for path in (ROOT / "docs" / "rules").glob("*.md")}
    stale = [name for name in sorted({*made, *kept}) if kept.get(name) != made.get(name)]
    assert stale == [], "run `make docs`"


def test_the_page_of_the_interface_is_current(tmp_path: Path) -> None:
    script = ROOT / "scripts" / "document_api.py"
    subprocess.run([sys.executable, str(script), str(tmp_path / "api.md")], check=True, cwd=ROOT)
    written = (tmp_path / "api.md").read_text()
    assert (ROOT / "docs" / "api.md").read_text() == written, "run `make docs`"


def test_tables_list_every_code() -> None:
    text = (ROOT / "docs" / "rules" / "README.md").read_text()
    rows = [line.split("|")[1].strip() for line in text.splitlines() if line.startswith("| [")]
    codes = (*(rule.code for rule in RULES), *STYLE)
    assert sorted(rows) == sorted(f"[{code}]({code}.md)" for code in codes)


def test_tables_have_a_heading_for_each_area() -> None:
    text = (ROOT / "docs" / "rules" / "README.md").read_text()
    areas = {
        path.relative_to(ROOT / "rules").parts[0] for path in (ROOT / "rules").glob("*/**/*.py")
    }
    assert re.findall(r"^## (\w+)$", text, re.MULTILINE) == sorted(areas)


@pytest.mark.parametrize("page", PAGES)
def test_links_and_paths_lead_somewhere(page: str) -> None:
    text = (ROOT / page).read_text()
    links = re.findall(r"\]\((?!https?:)([^)#]+)", text)
    paths = re.findall(r"`((?:benchmarks|docs|scaffold|scripts|templates|tests)/[\w./]+)`", text)
    named = [*((ROOT / page).parent / link for link in links), *(ROOT / path for path in paths)]
    assert [str(path) for path in named if not path.exists()] == []


def test_news_fragments_have_a_type() -> None:
    configured = tomllib.loads((ROOT / "pyproject.toml").read_text())["tool"]["towncrier"]
    types = {kind["directory"]: kind["name"] for kind in configured["type"]}
    assert list(types.values()) == ["Added", "Changed", "Fixed", "Removed"], "Keep a Changelog"
    directory = ROOT / configured["directory"]
    assert re.findall(r"\n\| `(\w+)` \| (\w+) \|", (directory / "README.md").read_text()) == list(
        types.items()
    )
    names = sorted(path.name for path in directory.iterdir() if path.name != "README.md")
    known = rf"(\d+|\+[\w-]+)\.({'|'.join(types)})\.md"
    assert [name for name in names if not re.fullmatch(known, name)] == []
