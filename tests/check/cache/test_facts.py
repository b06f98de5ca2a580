"""Which facts of an earlier run hold after files were edited."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from scaffold.check.cache.facts import EarlierFacts, to_store
from scaffold.model.facts import Fact, FactId, StoredFact, fact
from scaffold.model.package import Package

if TYPE_CHECKING:
    from collections.abc import Mapping

    from scaffold.check.cache.facts import Settled

OLD = "import os\n"


@fact
def count_of_imports(package: Package, path: str) -> int:
    """Return a number that is made of another fact."""
    return len(package.imports(path))


def stored(package: Package) -> Mapping[FactId, StoredFact]:
    """Ask for facts; return them as an earlier run stored them."""
    package.imports("a.py")
    package.occurrences("os")
    return to_store(package.facts, (), {})


def test_a_fact_is_made_again_once_for_all_that_ask() -> None:
    facts = stored(Package.of({"a.py": OLD}))
    package = Package.of({"a.py": f"{OLD}x = 1\n"})
    settled: Settled = {}
    made: list[object] = []
    for _ in range(2):
        earlier = EarlierFacts(package, facts, {"/a.py"}, settled)
        assert earlier.hold(facts)
        made.append(package.known_fact(next(iter(facts))[1]))
        earlier.end()
    assert made[0] is made[1]
    assert isinstance(made[0], Fact)
    assert to_store((), facts, settled) == facts


@pytest.mark.parametrize(("text", "count"), [("import re\n", 0), ("import os\nos.sep\n", 1)])
def test_a_fact_of_another_value_does_not_hold(text: str, count: int) -> None:
    facts = stored(Package.of({"a.py": OLD}))
    earlier = EarlierFacts(Package.of({"a.py": text}), facts, {"/a.py"}, {})
    assert sum(earlier.hold([wanted]) for wanted in facts) == count


def test_a_fact_of_an_unedited_file_is_not_made_again() -> None:
    facts = stored(Package.of({"a.py": OLD}))
    package = Package.of({})  # there is nothing to make it of
    settled: Settled = {}
    earlier = EarlierFacts(package, facts, (), settled)
    assert earlier.hold(facts)
    assert package.imports("a.py") == {"os"}
    assert settled == facts


def test_a_recalled_fact_knows_what_it_is_made_of() -> None:
    package = Package.of({"a.py": OLD})
    count_of_imports(package, "a.py")
    facts = to_store(package.facts, (), {})
    earlier = EarlierFacts(Package.of({}), facts, (), {})
    recalled = [earlier.recall(wanted) for wanted in facts if "count" in str(wanted)]
    assert to_store(filter(None, recalled), (), {}) == facts
    assert len(facts) == 2
