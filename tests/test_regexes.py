"""Every regular expression over user text takes linear time, judged by its form."""

from __future__ import annotations

import re

import pytest

from scaffold.ament.flake8.pycodestyle import statements
from scaffold.api import Package
from scaffold.formats.xml_reader import parse
from scaffold.generate.edit import readme
from scaffold.source import Source
from tests.regexes import ANCHORED, Pattern, dangers, patterns

SLOW = {
    "attributes of XML": r"""([^ \t\r\n=]+)[ \t\r\n]*=[ \t\r\n]*(?:"([^"]*)"|'([^']*)')""",
    "delimiters of tables": r"\A\s*\|?\s*:?-+:?\s*(\|\s*:?-+:?\s*)*\|?\s*\Z",
    "comparisons": r"(\bNone|\bFalse|\bTrue)?\s*([=!]=)\s*(?(1)|(None|False|True))\b",
    "types": r"[=!]=\s+type(?:\s*\(\s*([^)]*[^ )])\s*\))",
    "negations": r"\b(?<!is\s)(not)\s+[^][)(}{ ]+\s+(in|is)\s",
    "sentences": r"\A\S*[./]\S*$",
    "arguments": r"^\s*(\w+)\s*(\(.*?\))?\s*:\n?\s*.+",
    "versions": r"\A(\d+)\.(\d+)[\d.]*\Z",
    "places": r"%(?:%|[-+ #0]*(?:\*|\d+)?[diouxXeEfFgGcrsa])",
    "a repeat of a repeat": r"\A(?:a+)+b",
    "a repeat of groups that meet": r"\A(?:a\s*b?\s*)*c",
    "a search from anywhere": r"\w+@",
    "a prefix inside of the repeat": r"<[^>]*>",
    "line ends before a line": r"(?m)^\s*x",
}
FAST = {
    "one repeat": r"\A\w+@",
    "a quoted text": r'"[^"]*"',
    "a comment": r"(?m)#.*$",
    "words with signs between": r"\A\w+(?:\.\w+)*:",
    "a word from its start": r"\b\w+@",
    "a name behind a blank": r"(?<![^ \t])[^ \t=]+[ \t]*=",
    "what is left of a line": r"\Acopyright\s+(?m:.+$)",
    "a list": r"\A[A-Z]+[0-9]+(?:[\s,]+[A-Z]+[0-9]+)*x",
}


@pytest.mark.parametrize("kind", SLOW)
def test_slow_patterns_are_detected(kind: str) -> None:
    assert dangers(SLOW[kind])


@pytest.mark.parametrize("kind", FAST)
def test_fast_patterns_are_accepted(kind: str) -> None:
    assert dangers(FAST[kind]) == []


def test_patterns_of_the_repository_take_linear_time() -> None:
    """Rewrite the pattern, or say beside it in a comment ``# linear:`` what bounds its input."""
    found = list(patterns())
    assert len({pattern.text for pattern in found}) > 150
    slow = {f"{one.path}:{one.line}": dangers_of(one) for one in found}
    assert {place: reasons for place, reasons in slow.items() if reasons} == {}


def dangers_of(pattern: Pattern) -> list[str]:
    is_search = not pattern.methods <= ANCHORED
    return dangers(pattern.text, pattern.flags, is_search=is_search)


# -- the same verdicts as before


def test_xml_attributes_are_read_with_their_positions() -> None:
    text = "<a b='1'\n c = \"d='2'\" é='3'\t\r\n x-y=''/>"
    attributes = parse(Source("a.xml", text)).root.attributes
    assert {name: one.value for name, one in attributes.items()} == {
        "b": "1",
        "c": "d='2'",
        "é": "3",
        "x-y": "",
    }
    assert attributes["c"].name_location.column == 2


@pytest.mark.parametrize(
    ("line", "is_delimiter"),
    [
        ("|---|:-:|", True),
        ("--- | ---:", True),
        (" | - | ", True),
        ("---", True),
        ("||---|", False),
        ("| a |", False),
        ("|", False),
        ("--- ---", False),
        ("|---|---||", False),
    ],
)
def test_delimiter_rows_of_tables(line: str, *, is_delimiter: bool) -> None:
    pattern = r"\s*\|?\s*:?-+:?\s*(\|\s*:?-+:?\s*)*\|?\s*"
    assert bool(re.fullmatch(pattern, line)) == is_delimiter
    assert bool(readme._DELIMITER.fullmatch(line)) == is_delimiter  # noqa: SLF001  its rows are tested elsewhere


@pytest.mark.parametrize(
    ("line", "codes"),
    [
        ("x == None", ["E711"]),
        ("None   ==   x", ["E711"]),
        ("x   !=   True", ["E712"]),
        ("False != x == None", ["E712", "E711"]),
        ("x == y", []),
        ("type(a) == type(b)", ["E721"]),
        ("type( a )  != type( b )", ["E721"]),
        ("x == type( a )", []),
        ("x == type(a.b)", ["E721"]),
        ("x == type(  )", []),
    ],
)
def test_comparisons_with_constants(line: str, codes: list[str]) -> None:
    assert [code for _, code, _ in statements.comparisons(line)] == codes


def test_huge_number_is_no_internal_error() -> None:
    from scaffold.check import runner
    from scaffold.check.rules import registry
    from scaffold.check.session import all_rules
    from scaffold.configuration import content

    digits = "9" * 5000
    package = Package.of(
        {
            "package.xml": "<package format='3'><name>a</name>"
            f"<url>https://ros.example.org:{digits}/</url></package>",
            "CMakeLists.txt": f"cmake_minimum_required(VERSION {digits}.{digits})\nproject(a)\n",
        }
    )
    rules = [rule() for rule in all_rules(registry.load(content.roots("rules", ())))]
    found = runner.check(package, rules)
    assert "SC002" not in {diagnostic.code for diagnostic in found}
