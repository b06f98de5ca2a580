"""setup.cfg: locations, values and edits, compared with what setuptools reads."""

from __future__ import annotations

import configparser
import io

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from scaffold.edits import Edit
from scaffold.formats.ini import IniFile
from scaffold.source import ParseError, Source

TALKER = """\
# Where ros2 run looks.
[develop]
script_dir=$base/lib/talker
[install]
install-scripts = $base/lib/talker

[options.entry_points]
console_scripts =
    talk = talker.talk:main
    # not yet
    listen = talker.listen:main

zip_safe : True
"""


def read(text: str) -> IniFile:
    return IniFile.parse(Source("setup.cfg", text))


def apply(text: str, edit: Edit) -> str:
    return text[: edit.start] + edit.text + text[edit.end :]


def test_values_of_options() -> None:
    file = read(TALKER)
    assert list(file.sections) == ["develop", "install", "options.entry_points"]
    assert file.get("develop", "script_dir") == "$base/lib/talker"
    assert file.get("options.entry_points", "console_scripts") == (
        "\ntalk = talker.talk:main\nlisten = talker.listen:main"
    )
    assert file.get("options.entry_points", "zip_safe") == "True"
    assert file.get("develop", "other") is None
    assert file.get("other", "script_dir") is None


def test_option_is_found_under_alternative_spellings() -> None:
    option = read(TALKER).option("install", "install_scripts", "install-scripts")
    assert option is not None
    assert option.key == "install-scripts"


def test_locations_of_sections_and_options() -> None:
    file = read(TALKER)
    section = file.sections["install"]
    assert section.location[1:] == (4, 1, 4, 10)
    assert section.name_location[1:] == (4, 2, 4, 9)
    option = section.options["install-scripts"]
    assert option.key_location[1:] == (5, 1, 5, 16)
    assert option.location[1:] == (5, 19, 5, 35)
    assert TALKER[option.value_start : option.value_end] == "$base/lib/talker"


def test_locations_of_lines_of_a_value() -> None:
    option = read(TALKER).option("options.entry_points", "console_scripts")
    assert option is not None
    assert [(line.text, line.location[1:]) for line in option.lines] == [
        ("talk = talker.talk:main", (9, 5, 9, 28)),
        ("listen = talker.listen:main", (11, 5, 11, 32)),
    ]
    assert option.location[1:] == (9, 5, 11, 32)
    assert option.key_location[1:] == (8, 1, 8, 16)


def test_location_of_an_empty_value() -> None:
    option = read("[a]\nb =\n").option("a", "b")
    assert option is not None
    assert (option.value, option.lines) == ("", ())
    assert option.location[1:] == (2, 4, 2, 4)


def test_defaults_apply_to_every_section() -> None:
    file = read("[DEFAULT]\na=1\n[b]\nc=2\n")
    assert file.get("b", "a") == "1"
    assert file.get("c", "a") is None


@pytest.mark.parametrize(
    ("text", "at", "message"),
    [
        ("a=1\n", "1:1", "a section such as [develop] expected before this line"),
        ("\ufeff[a]\n", "1:1", "a section such as [develop] expected before a byte order mark"),
        ("[a]\nb\n", "2:1", '"=" expected after the key'),
        ("[a]\n = b\n", "2:2", 'a key expected before "="'),
        ("[a]\n[b]\n[a]\n", "3:1", "the section [a] is in line 1 already"),
        ("[a]\nb=1\nb : 2\n", "3:1", "b is set in line 2 already"),
    ],
)
def test_syntax_errors(text: str, at: str, message: str) -> None:
    with pytest.raises(ParseError) as caught:
        read(text)
    location = caught.value.location
    assert (f"{location.line}:{location.column}", caught.value.message) == (at, message)


PIECES = (
    ("[a]", "[b]", "[DEFAULT]", "\n[c]\n", "x", "y", "=", ":", "\n", "\r\n", "\r", " ", "\t"),
    ("  more\n", "#", "; c", "\n\n", "[", "]", "\x0b", "\x1c", "\u2003", "\ufeff", "z = 1\n", "é"),
)
TEXTS = st.lists(st.sampled_from([*PIECES[0], *PIECES[1]]), max_size=14).map("".join)


@given(st.one_of(TEXTS, TEXTS.map("[s]\n{}".format), st.text(max_size=30)))
@example(TALKER)
@example("[a]\nb" + " " * 5000 + "c")
def test_values_equal_those_of_configparser(text: str) -> None:
    expected = by_configparser(text)
    if expected is None:
        with pytest.raises(ParseError):
            read(text)
        return
    file = read(text)
    assert {
        name: {option.key: option.value for option in section.options.values()}
        for name, section in file.sections.items()
        if name != configparser.DEFAULTSECT
    } == expected
    for option in file.options:
        assert text.startswith(option.key, option.key_start)
        for line in option.lines:
            at = file.source.offset(line.location.line, line.location.column)
            assert text.startswith(line.text, at)


def by_configparser(text: str) -> dict[str, dict[str, str]] | None:
    """Return the options of every section, without the defaults; setuptools keeps the case."""
    parser = configparser.RawConfigParser()
    parser.optionxform = str  # type: ignore[assignment, method-assign]  # the documented way
    try:
        parser.read_file(io.StringIO(text, newline=None))
    except configparser.Error:
        return None
    for key in list(parser.defaults()):
        parser.remove_option(configparser.DEFAULTSECT, key)
    return {name: dict(parser.items(name)) for name in parser.sections()}


@pytest.mark.parametrize("newline", ["\n", "\r\n"])
@pytest.mark.parametrize(
    ("section", "key", "before", "after"),
    [
        ("develop", "script_dir", "script_dir=$base/lib/talker", "script_dir=new"),
        (
            "develop",
            "other",
            "script_dir=$base/lib/talker",
            "script_dir=$base/lib/talker\nother=new",
        ),
        ("third", "key", "zip_safe : True\n", "zip_safe : True\n[third]\nkey=new\n"),
    ],
)
def test_set_option(section: str, key: str, before: str, after: str, newline: str) -> None:
    text = TALKER.replace("\n", newline)
    expected = TALKER.replace(before, after).replace("\n", newline)
    changed = apply(text, read(text).set(section, key, "new"))
    assert changed == expected
    assert read(changed).get(section, key) == "new"


def test_set_option_in_an_empty_file() -> None:
    assert apply("", read("").set("a", "b", "c")) == "[a]\nb=c\n"


def test_rename_option() -> None:
    file = read(TALKER)
    option = file.option("install", "install-scripts")
    assert option is not None
    after = apply(TALKER, file.rename(option, "install_scripts"))
    assert after == TALKER.replace("install-scripts", "install_scripts")
