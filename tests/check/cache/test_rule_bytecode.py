"""The cached bytecode of rules matches the rule files."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path

import pytest

from scaffold.check.cache import rule_bytecode
from scaffold.check.rules import registry
from scaffold.errors import ContentError
from scaffold.files import cache

RULE = '''
from scaffold.api import Rule


class A(Rule):
    """Doc."""

    code = "CM00{}"
    name = "{}"
    examples = ()
'''


@pytest.fixture
def root(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    monkeypatch.delenv(cache.SWITCH, raising=False)
    root = tmp_path / "rules"
    (root / "cmake").mkdir(parents=True)
    write(root, "first", 1)
    return root


def write(root: Path, name: str, number: int) -> Path:
    path = root / "cmake" / f"{name}.py"
    path.write_text(RULE.format(number, name))
    return path


def codes(root: Path) -> list[str]:
    return [rule.code for rule in registry.load([str(root)])]


def bytecode_file(root: Path) -> Path:
    (path,) = (root.parent / "cache" / "ros2-scaffold" / "rules").iterdir()
    return path


def test_cached_rules_are_not_compiled_again(root: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(path: str) -> None:
        raise AssertionError(path)

    assert codes(root) == ["CM001"]
    monkeypatch.setattr(registry, "_compile", fail)
    assert codes(root) == ["CM001"]


def edit_in_the_same_size_and_time(root: Path) -> list[str]:
    path = root / "cmake" / "first.py"
    before = path.stat()
    write(root, "first", 2)
    os.utime(path, ns=(before.st_atime_ns, before.st_mtime_ns))
    # The stamp differs; Python's own .pyc is known by size and seconds only.
    for cached in path.parent.glob("__pycache__/*"):
        cached.unlink()
    return ["CM002"]


def add(root: Path) -> list[str]:
    write(root, "second", 2)
    return ["CM001", "CM002"]


def replace(root: Path) -> list[str]:
    (root / "cmake" / "first.py").unlink()
    write(root, "third", 3)
    return ["CM003"]


@pytest.mark.parametrize("change", [edit_in_the_same_size_and_time, add, replace])
def test_change_is_noticed(root: Path, change: Callable[[Path], list[str]]) -> None:
    codes(root)
    expected = change(root)
    assert codes(root) == expected


def test_damaged_bytecode_is_ignored(root: Path) -> None:
    codes(root)
    whole = bytecode_file(root).read_bytes()
    for at in range(0, len(whole), 61):
        bytecode_file(root).write_bytes(whole[:at] + bytes([whole[at] ^ 0x41]) + whole[at + 1 :])
        assert codes(root) == ["CM001"]
        assert bytecode_file(root).read_bytes() == whole


def test_disabled_cache(root: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(cache.SWITCH, "1")
    assert codes(root) == ["CM001"]
    assert not (root.parent / "cache").exists()


def test_broken_rule_is_reported(root: Path) -> None:
    (root / "cmake" / "broken.py").write_text("def :\n")
    for _ in range(2):
        with pytest.raises(ContentError, match=r"broken\.py: SyntaxError"):
            codes(root)


def test_number_of_cached_directories_is_limited(root: Path, tmp_path: Path) -> None:
    for number in range(rule_bytecode.MAX_ROOTS + 3):
        other = tmp_path / str(number)
        (other / "cmake").mkdir(parents=True)
        write(other, "first", 1)
        codes(other)
    assert len(list((tmp_path / "cache" / "ros2-scaffold" / "rules").iterdir())) <= 16
    assert codes(root) == ["CM001"]
