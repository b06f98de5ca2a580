"""Which facts of an earlier run are still valid after an edit."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from scaffold.check.cache.facts import EarlierFacts, to_store
from scaffold.model.facts import fact
from scaffold.model.package import Package
from scaffold.model.rclpy.evaluation.attributes import is_used_elsewhere
from scaffold.model.rclpy.file import rclpy_file
from scaffold.model.reads import Fact, FactId, StoredFact

if TYPE_CHECKING:
    from collections.abc import Mapping

    from scaffold.model.reads import Settled

OLD = "import os\n"


@fact
def count_of_imports(package: Package, path: str) -> int:
    """Return a number computed from another fact."""
    return len(package.imports(path))


def stored(package: Package) -> Mapping[FactId, StoredFact]:
    """Compute facts; return them as an earlier run stored them."""
    package.imports("a.py")
    package.is_mentioned_once("os", "a.py")
    return to_store(package.facts, (), {})


def test_fact_is_computed_again_once() -> None:
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
def test_fact_with_changed_value_is_invalid(text: str, count: int) -> None:
    facts = stored(Package.of({"a.py": OLD}))
    earlier = EarlierFacts(Package.of({"a.py": text}), facts, {"/a.py"}, {})
    assert sum(earlier.hold([wanted]) for wanted in facts) == count


def test_fact_of_an_unedited_file_is_not_computed_again() -> None:
    facts = stored(Package.of({"a.py": OLD}))
    package = Package.of({})  # there is nothing to make it of
    settled: Settled = {}
    earlier = EarlierFacts(package, facts, (), settled)
    assert earlier.hold(facts)
    assert package.imports("a.py") == {"os"}
    assert settled == facts


def test_recalled_fact_keeps_its_dependencies() -> None:
    package = Package.of({"a.py": OLD})
    count_of_imports(package, "a.py")
    facts = to_store(package.facts, (), {})
    earlier = EarlierFacts(Package.of({}), facts, (), {})
    recalled = [earlier.recall(wanted) for wanted in facts if "count" in str(wanted)]
    assert to_store(filter(None, recalled), (), {}) == facts
    assert len(facts) == 2


@pytest.mark.parametrize(
    ("other", "holds"), [("y = 2\n", True), ("tick()\n", False), ("tick.tock = 1\n", False)]
)
@pytest.mark.parametrize("own", ["def tick(): ...\n", "def tick(): ...\n\n\ntick()\n"])
def test_word_used_twice_in_its_file_does_not_depend_on_other_files(
    own: str, other: str, *, holds: bool
) -> None:
    package = Package.of({"a.py": own, "b.py": "y = 1\n"})
    is_once = package.is_mentioned_once("tick", "a.py")
    facts = to_store(package.facts, (), {})
    earlier = EarlierFacts(Package.of({"a.py": own, "b.py": other}), facts, {"/b.py"}, {})
    assert earlier.hold(facts) is (holds or not is_once)


@pytest.mark.parametrize(
    ("other", "is_used"),
    [
        ("def stop(node):\n    node.worker.start()\n", True),
        ("class B:\n    def run(self):\n        self.worker.start()\n", True),
        (
            "class B:\n    def run(self):\n        self.worker = 1\n        self.worker += 1\n",
            False,
        ),
        ("worker = 1\n", False),
    ],
)
def test_attribute_is_searched_again_only_in_the_edited_file(other: str, *, is_used: bool) -> None:
    texts = {"a.py": "class A:\n    def __init__(self):\n        self.worker = 1\n", "c.py": ""}
    package = Package.of({**texts, "b.py": "y = 1\n"})
    assert not is_used_elsewhere(package, rclpy_file(package, "a.py"), "worker")
    facts = to_store(package.facts, (), {})
    edited = Package.of({**texts, "b.py": other})
    earlier = EarlierFacts(edited, facts, {"/b.py"}, {})
    assert earlier.hold(facts) is not is_used
    assert not edited.parsed_module("c.py")
    assert is_used_elsewhere(edited, rclpy_file(edited, "a.py"), "worker") is is_used
