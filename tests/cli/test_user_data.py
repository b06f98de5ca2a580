"""Files written by users: an error is one message with file and line."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from scaffold.cli.main import main
from scaffold.configuration import config
from scaffold.errors import ConfigError, InputError
from scaffold.generate import yaml_file

BOMB = "a: &a [x, x, x, x, x, x, x, x, x]\n" + "".join(
    f"{name}: &{name} [{', '.join([f'*{before}'] * 9)}]\n"
    for before, name in zip("abcdefgh", "bcdefghi", strict=True)
)

BROKEN = {
    "a tag": ("rate: 1\nlicense: !!timestamp 2024-13-45\n", 2, "the tag '!!timestamp'"),
    "an object": ("a: !!python/object/apply:os.system [x]\n", 1, "the tag '!!python/object"),
    "a bad int": ("\n\nrate: 0b_\n", 3, "is not a number"),
    "a bad float": ("rate: 1_:_\nx: [\n", 3, "invalid YAML"),
    "a huge int": (f"rate: {'9' * 5000}\n", 1, "a number of 5000 characters"),
    "a huge hexadecimal int": (f"rate: 0x{'f' * 9000}\n", 1, "a number of 9002 characters"),
    "a bomb of aliases": (BOMB, 2, "the alias *a"),
    "an alias of itself": ("a: &a [*a]\n", 1, "the alias *a"),
    "a merge key": ("a: 1\n<<: {b: 1}\n", 2, "the merge key <<"),
    "a duplicate key": ("rate: 1\nrate: 2\n", 2, "the key 'rate' is a duplicate"),
    "a key that is a list": ("a: 1\n? [b]\n: 1\n", 2, "a key that is not a string"),
    "deep lists": (f"a:\n  {'[' * 50}{']' * 50}\n", 2, "nested more than 40 levels deep"),
    "very deep lists": ("[" * 200_000, 1, ""),
    "two documents": ("a: 1\n---\nb: 1\n", 2, "a second document"),
    "an open list": ("a: [1,\nb: ]}", 2, "invalid YAML"),
    "NUL": ("a: 1\nb: \0\n", 0, "invalid YAML"),
}


@pytest.mark.parametrize("name", BROKEN)
def test_broken_yaml_is_rejected_with_its_line(name: str, tmp_path: Path) -> None:
    text, line, reason = BROKEN[name]
    path = tmp_path / "answers.yaml"
    path.write_text(text)

    with pytest.raises(InputError) as caught:
        yaml_file.read(str(path))

    place = f"{path}:{line}: " if line else f"{path}: "
    assert str(caught.value).startswith(place)
    assert reason in str(caught.value)
    assert len(str(caught.value).splitlines()) == 1


def test_yaml_in_other_encodings_is_rejected(tmp_path: Path) -> None:
    path = tmp_path / "answers.yaml"
    path.write_bytes(b"a: 1\nb: caf\xe9\n")

    with pytest.raises(InputError, match=rf"^{path}:2: not UTF-8$"):
        yaml_file.read(str(path))


def test_too_large_file_is_not_read(tmp_path: Path) -> None:
    path = tmp_path / "answers.yaml"
    with path.open("wb") as file:
        file.truncate(1 << 40)

    with pytest.raises(InputError, match="larger than"):
        yaml_file.read(str(path))


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("2024-01-31", "2024-01-31"),
        ("2024-13-45", "2024-13-45"),
        ("yes", True),
        ("'yes'", "yes"),
        ("!!str 5", "5"),
        ("5", 5),
        ("2.5", 2.5),
        ("~", None),
        ("|-\n  5", "5"),
        ("", None),
        ("[a, {b: c}]", ["a", {"b": "c"}]),
        ("=", "="),
    ],
)
def test_yaml_scalars(text: str, value: object, tmp_path: Path) -> None:
    path = tmp_path / "answers.yaml"
    path.write_text(f"\ufeff1: {text}\n")

    assert yaml_file.read(str(path)) == {"1": value}


ODD = (
    *("2024-01-31", "0b_", "9" * 5000, "0x" + "f" * 5000, "!!binary aGk=", "[[[[1]]]]", "{a: {}}"),
    *(".nan", ".inf", "-1", "''", '"\\0"', '"\\uD800"', "1:30", "~", "[]", "{}", "[~]", "yes"),
)
"""Answers that fit nowhere, or that YAML reads in an odd way."""


@pytest.mark.parametrize("question", ["package", "license", "rate", "dependencies", "add", "qos"])
def test_odd_answers_are_user_errors(
    question: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    for number, odd in enumerate(ODD):
        answers = tmp_path / "answers.yaml"
        package = "" if question == "package" else f"package: talker{number}\n"
        answers.write_text(f"{package}{question}: {odd}\n")

        where = ["--destination-directory", str(tmp_path), "--diff"]
        code = main(["new", "--answers", str(answers), *where])

        error = capsys.readouterr().err
        assert code in {0, 2}, (odd, error)
        assert code == 0 or error.count("\n") == 1, error


@pytest.mark.parametrize(
    ("key", "value"),
    [
        ("summary", "2024-01-31"),
        ("summary", "5"),
        ("questions", "{q: 5}"),
        ("questions", "{q: {help: 5}}"),
        ("questions", "{q: {help: x, type: [text]}}"),
        ("questions", "{q: {help: x, choices: 5}}"),
        ("questions", "{q: {help: x, metavar: 5}}"),
        ("questions", "{q: {help: x, default: 2024-01-31, type: rate}}"),
        ("depends", "{exec: rclpy}"),
        ("depends", "{exec: [5]}"),
        ("groups", "[5]"),
        ("installs", "[{}]"),
        ("include", "{a: 5}"),
        ("notes", "{a: 5}"),
        ("examples", "{a: 5}"),
        ("examples", "[a]"),
        ("executable", "[5]"),
        ("build_types", "[5]"),
    ],
)
def test_odd_values_in_a_template_are_user_errors(
    key: str, value: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    template = tmp_path / "content" / "templates" / "extras" / "odd"
    template.mkdir(parents=True)
    entries = {"summary": "Something odd", key: value}
    lines = [f"{name}: {entry}\n" for name, entry in entries.items()]
    (template / "template.yaml").write_text("".join(lines))

    words = ["new", "talker", "--extras", "odd", "--diff", "--content", str(tmp_path / "content")]
    code = main([*words, "--destination-directory", str(tmp_path)])

    error = capsys.readouterr().err
    if value == "2024-01-31":
        assert code == 0
        return
    assert code == 2
    assert error.count("\n") == 1
    assert error.startswith("ros2-scaffold: error: ")
    assert "template.yaml" in error or "--q" in error or "default" in error


@pytest.mark.parametrize(
    ("data", "reason"),
    [
        (b"a = " + b"[" * 2000 + b"]" * 2000, "nested too deeply"),
        (b"a = " + b"[" * 200_000, "the limit is 100 kB"),
        (b"a = " + b"{a=" * 2000 + b"1" + b"}" * 2000, "nested too deeply"),
        (b"[check]\nselect = 9" + b"9" * 5000, "a number is too large"),
        (b"[check]\nselect = 0x" + b"f" * 5000, "a number is too large"),
        (b"[check]\nselect = []\nselect = []\n", "invalid TOML"),
        (b"[check]\nselect = ['\xff']\n", ":2: not UTF-8"),
        (b"[check]\nselect = 2024-01-31\n", "must be a list of strings"),
        (b"[check]\nselect = [1]\n", "must be a list of strings"),
        (b"a." * 5000 + b"a = 1\n", ""),
    ],
)
def test_odd_configuration_is_a_user_error(
    data: bytes, reason: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path))
    path = tmp_path / config.PROJECT_FILE
    path.write_bytes(data)

    with pytest.raises(ConfigError) as caught:
        config.load(str(tmp_path)).strings("check.select")

    assert str(caught.value).startswith(str(path))
    assert reason in str(caught.value)


@pytest.mark.parametrize(
    "change",
    [
        {"date": "2024-13-45"},
        {"date": 5},
        {"version": "9" * 5000},
        {"answers": {"package": "talker", "rate": [[[[[[[[[[[[1]]]]]]]]]]]]}},
        {"answers": {"package": ["talker"]}},
        {"rendered": "!"},
    ],
    ids=str,
)
def test_edited_record_is_a_user_error(
    change: dict[str, object], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["new", "talker", "--destination-directory", str(tmp_path)]) == 0
    record = tmp_path / "talker" / ".ros2-scaffold.json"
    record.write_text(json.dumps({**json.loads(record.read_text()), **change}))
    capsys.readouterr()

    assert main(["update", str(tmp_path / "talker")]) == 2

    error = capsys.readouterr().err
    assert error.count("\n") == 1
    assert ".ros2-scaffold.json: " in error
