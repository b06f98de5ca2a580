"""Text cut and wrapped to the width of a terminal."""

from __future__ import annotations

import pytest

from scaffold.columns import columns, cut, wrapped

RED = "\033[31mproblem:\033[0m"


@pytest.mark.parametrize(
    ("text", "width"),
    [("", 0), ("plain", 5), (RED, 8), ("速度", 4), ("e\u0301", 1), ("Größe", 5)],
)
def test_width_in_columns(text: str, width: int) -> None:
    assert columns(text) == width


@pytest.mark.parametrize(
    ("text", "shown"),
    [("fits well", "fits well"), ("fits no more", "fits n..."), ("速度速度速度", "速度速...")],
)
def test_cut_to_width(text: str, shown: str) -> None:
    assert cut(text, 9) == shown


@pytest.mark.parametrize(
    ("line", "parts"),
    [
        ("  short", ["  short"]),
        ("  one two three four five six", ["  one two three four", "      five six"]),
        (f"  {RED} it crashes at start", [f"  {RED} it", "      crashes at", "      start"]),
        ("/a/topic  1 publisher  10.00 Hz", ["/a/topic", "    1 publisher", "    10.00 Hz"]),
        ("/a/topic/longer/than/this hears", ["/a/topic/longer/than/this", "    hears"]),
    ],
)
def test_wrapped_to_width(line: str, parts: list[str]) -> None:
    assert [*wrapped(line, 20 if "crashes" not in line else 16)] == parts
