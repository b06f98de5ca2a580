"""The catalogue of mistakes names rules that exist, and all of them."""

from __future__ import annotations

import re
from pathlib import Path

from scaffold.check import registry
from scaffold.check.session import all_rules
from scaffold.configuration import content

CODES = {rule.code for rule in all_rules(registry.load(content.roots("rules")))}
TEXT = (Path(__file__).parents[2] / "docs" / "catalogue.md").read_text()
AREAS = "|".join(sorted({code[:2] for code in CODES}))
NAMED = set(re.findall(rf"\b(?:{AREAS})\d{{3}}\b", TEXT))


def test_every_named_rule_exists() -> None:
    assert not NAMED - CODES


def test_every_rule_is_named() -> None:
    assert not CODES - NAMED
