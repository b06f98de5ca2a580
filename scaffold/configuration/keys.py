"""Every key of the configuration: its type, its default and its documentation, in one table.

The validation, the table in docs/configuration.md, the JSON schema and `ros2-scaffold config` are
all derived from it.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from scaffold import distributions, lazy_re
from scaffold.record import NamedTuple

SEVERITIES = ("error", "warning", "info")
STYLES = ("all", "own")
FOREIGN = ("submodules", "gitignored", "vendored", "copies")


class Kind(NamedTuple):
    """The type of a value."""

    noun: str
    """The noun with its article."""
    refuse: Callable[[Any], str]
    """Returns the error about a value, to follow its key; empty if it is valid."""
    schema: dict[str, Any]
    """The type as a JSON schema."""


class Key(NamedTuple):
    """A key of the configuration."""

    table: str
    """The table; empty for the top level."""
    name: str
    kind: Kind
    default: Any
    summary: str
    """Markdown, for the documentation and the schema."""
    is_projects: bool = False
    """Whether it is only allowed in a project's file, as its paths are relative to it."""

    @property
    def path(self) -> str:
        """``table.name``, as `ros2-scaffold config` shows it."""
        return f"{self.table}.{self.name}" if self.table else self.name


def _must_be(noun: str) -> str:
    return f"must be {noun}"


def _is_text(value: object) -> bool:
    return isinstance(value, str) and "\0" not in value


_CHARACTERS = lazy_re.compile(r"\[!?\]?[^\]]{0,99}\]")
"""A character class in a pattern."""


def _is_list_of_strings(value: object) -> bool:
    return isinstance(value, list) and all(map(_is_text, value))


def _refuse_strings(value: Any) -> str:  # noqa: ANN401  of any type in TOML
    if not _is_list_of_strings(value):
        return _must_be(_STRINGS_NOUN)
    return "" if all(value) else "has an empty string"


def _refuse_directories(value: Any) -> str:  # noqa: ANN401  likewise
    is_valid = _is_list_of_strings(value) and all(value)
    return "" if is_valid else _must_be(_DIRECTORIES_NOUN)


def _refuse_patterns(value: Any) -> str:  # noqa: ANN401  likewise
    if not _is_list_of_strings(value):
        return _must_be(_STRINGS_NOUN)
    for pattern in value:
        if pattern.startswith("/") or ".." in pattern.split("/") or not pattern.strip("./"):
            return f"has {pattern!r}: a pattern is a path below the directory of this file"
        if "[" in _CHARACTERS.sub("", pattern):
            return f"has {pattern!r}: its '[' is never closed; write '[[]' for a literal '['"
    return ""


def _refuse_lists_by_pattern(value: Any) -> str:  # noqa: ANN401  likewise
    if not isinstance(value, dict) or not all(map(_is_list_of_strings, value.values())):
        return _must_be(_LISTS_BY_PATTERN_NOUN)
    return "" if all(map(all, value.values())) else "has an empty string"


def _refuse_severities(value: Any) -> str:  # noqa: ANN401  likewise
    if not isinstance(value, dict):
        return _must_be(_SEVERITIES_NOUN)
    for rule, severity in value.items():
        if severity not in SEVERITIES:
            hint = nearest(severity, SEVERITIES)
            return f"has {severity!r} for {rule!r}, which is not a severity; {hint}"
    return ""


def _refuse_number(value: Any) -> str:  # noqa: ANN401  likewise
    is_number = isinstance(value, int) and not isinstance(value, bool)
    return "" if is_number and 1 <= value <= LONGEST_LINE else _must_be(_NUMBER_NOUN)


def _refuse_distribution(value: Any) -> str:  # noqa: ANN401  likewise
    names = [value] if isinstance(value, str) else value
    if not _is_list_of_strings(names) or not names:
        return _must_be(_DISTRIBUTION_NOUN)
    for name in names:
        if name not in distributions.NAMES:
            words = ", ".join(f'"{word}"' for word in name.replace(",", " ").split())
            return f"is wrong: {distributions.refusal(name, f'write a list: [{words}]')}"
    return ""


def _refuse_kinds(value: Any) -> str:  # noqa: ANN401  likewise
    if not _is_list_of_strings(value):
        return _must_be(_KINDS_NOUN)
    for kind in value:
        if kind not in FOREIGN:
            return f"has {kind!r}, which is not a choice; {nearest(kind, FOREIGN)}"
    return ""


def _refuse_style(value: Any) -> str:  # noqa: ANN401  likewise
    if value in STYLES:
        return ""
    return f"has {value!r}, which is not a choice; {nearest(value, STYLES)}"


_STRINGS_NOUN = "a list of strings"
_DIRECTORIES_NOUN = "a list of directories"
_LISTS_BY_PATTERN_NOUN = "a table of patterns with lists of strings"
_SEVERITIES_NOUN = "a table of rules with severities"
LONGEST_LINE = 10_000
_NAMES = ", ".join(f"`{name}`" for name in distributions.NAMES)
_DISTRIBUTION_NOUN = f"one of {_NAMES}, or a list of them"
_ONE_DISTRIBUTION = {"enum": [*distributions.NAMES]}
_NUMBER_NOUN = f"a number from 1 to {LONGEST_LINE}"
_KINDS_NOUN = "a list of `submodules`, `gitignored`, `vendored` and `copies`"
_STRINGS = {"type": "array", "items": {"type": "string", "minLength": 1}}

STRINGS = Kind(_STRINGS_NOUN, _refuse_strings, _STRINGS)
DIRECTORIES = Kind(
    _DIRECTORIES_NOUN,
    _refuse_directories,
    _STRINGS,
)
PATTERNS = Kind("a list of patterns", _refuse_patterns, _STRINGS)
LISTS_BY_PATTERN = Kind(
    _LISTS_BY_PATTERN_NOUN,
    _refuse_lists_by_pattern,
    {"type": "object", "additionalProperties": _STRINGS},
)
SEVERITIES_BY_RULE = Kind(
    _SEVERITIES_NOUN,
    _refuse_severities,
    {"type": "object", "additionalProperties": {"enum": [*SEVERITIES]}},
)
FOREIGN_KINDS = Kind(_KINDS_NOUN, _refuse_kinds, {"type": "array", "items": {"enum": [*FOREIGN]}})
NUMBER = Kind(
    _NUMBER_NOUN, _refuse_number, {"type": "integer", "minimum": 1, "maximum": LONGEST_LINE}
)
DISTRIBUTION = Kind(
    _DISTRIBUTION_NOUN,
    _refuse_distribution,
    {"anyOf": [_ONE_DISTRIBUTION, {"type": "array", "items": _ONE_DISTRIBUTION, "minItems": 1}]},
)
STYLE = Kind('`"all"` or `"own"`', _refuse_style, {"enum": [*STYLES]})

KEYS = (
    Key(
        "",
        "content",
        DIRECTORIES,
        [],
        "Directories with your own `rules/` and `templates/`, relative to the file. They are code: "
        "the file of a project may set this only if you trust its directory.",
    ),
    Key("check", "select", STRINGS, [], "Report only these rules; empty for all."),
    Key("check", "ignore", STRINGS, [], "Do not report these rules."),
    Key(
        "check",
        "per-path-ignores",
        LISTS_BY_PATTERN,
        {},
        "Do not report these rules in files whose path matches, relative to their package or to "
        "the file.",
    ),
    Key(
        "check",
        "severity",
        SEVERITIES_BY_RULE,
        {},
        "Report these rules as `error`, `warning` or `info`; the longest matching "
        "prefix of a code decides.",
    ),
    Key(
        "check",
        "exclude",
        PATTERNS,
        [],
        "Do not check packages and files whose path or a parent directory matches; relative to the "
        "file.",
        is_projects=True,
    ),
    Key(
        "check",
        "default-excludes",
        FOREIGN_KINDS,
        [*FOREIGN],
        "What to exclude in addition to `exclude`, because somebody else maintains it: git "
        "submodules, files that git ignores, vendored code, copies made by editors and file "
        "synchronization.",
    ),
    Key(
        "check",
        "style",
        STYLE,
        "all",
        "`own` reports style and docstring findings only in files on which the tests of the "
        "package run that linter.",
    ),
    Key(
        "check",
        "line-length",
        NUMBER,
        99,
        "The maximum line length (E501) in packages whose tests do not run "
        "`ament_flake8`; the others set it there.",
    ),
    Key(
        "check",
        "licenses",
        STRINGS,
        [],
        "The allowed licenses, as SPDX identifiers (SC008); empty for any.",
    ),
    Key(
        "check",
        "implicit-dependencies",
        STRINGS,
        [],
        "Packages, rosdep keys and Python modules that are always installed and need not be "
        "declared.",
    ),
    Key(
        "check",
        "distribution",
        DISTRIBUTION,
        distributions.DEFAULT,
        "The ROS 2 distributions that `check` checks for, and that `new` creates packages for.",
    ),
)
"""In the order of the documentation."""

ANSWERS = "new"
"""The table with answers to questions; the templates define its keys."""
ANSWERS_SUMMARY = "Answers to the questions of `new` and `add`, by name."
TABLES = (*dict.fromkeys(key.table for key in KEYS if key.table), ANSWERS)


def of_table(table: str) -> dict[str, Key]:
    """Return the keys of a table by name; those of the top level for an empty name."""
    return {key.name: key for key in KEYS if key.table == table}


def nearest(word: object, choices: Sequence[str]) -> str:
    """Return a hint: the choice closest to a wrong word, or all choices."""
    from difflib import get_close_matches

    closest = get_close_matches(str(word), choices, n=1)
    return f"did you mean {closest[0]!r}?" if closest else f"choose from {', '.join(choices)}"


def schema() -> dict[str, Any]:
    """Return the JSON schema of ``ros2-scaffold.toml``."""

    def properties(table: str) -> dict[str, Any]:
        return {
            name: {"description": key.summary, "default": key.default, **key.kind.schema}
            for name, key in of_table(table).items()
        }

    tables = {
        table: {
            "type": "object",
            "additionalProperties": False,
            "properties": properties(table),
        }
        for table in TABLES
        if table != ANSWERS
    }
    answers = {"type": "object", "description": ANSWERS_SUMMARY}
    return {
        "$schema": "http://json-schema.org/draft-07/schema#",
        "title": "ros2-scaffold.toml",
        "description": "Configuration of ros2-scaffold",
        "type": "object",
        "additionalProperties": False,
        "properties": {**properties(""), **tables, ANSWERS: answers},
    }
