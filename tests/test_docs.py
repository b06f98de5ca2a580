"""The documentation of the rules is made from the rules; `make docs` renews it."""

from __future__ import annotations

from pathlib import Path

from scaffold import content
from scaffold.check import docs, registry
from scaffold.check.session import all_rules

ROOT = Path(__file__).parent.parent
RULES = all_rules(registry.load(content.roots("rules")))


def test_pages_are_current(tmp_path: Path) -> None:
    docs.write(str(tmp_path), RULES)
    made = {path.name: path.read_text() for path in tmp_path.iterdir()}
    kept = {path.name: path.read_text() for path in (ROOT / "docs" / "rules").glob("*.md")}
    stale = [name for name in sorted({*made, *kept}) if kept.get(name) != made.get(name)]
    assert stale == [], "run `make docs`"


def test_table_lists_every_rule() -> None:
    text = (ROOT / "docs" / "rules" / "README.md").read_text()
    assert [line.split("|")[1].strip() for line in text.splitlines() if line.startswith("| [")] == [
        f"[{rule.code}]({rule.code}.md)" for rule in RULES
    ]
