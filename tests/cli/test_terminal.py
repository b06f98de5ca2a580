"""Terminal output: control characters in foreign text are escaped, in one module."""

from __future__ import annotations

import ast
import json
import sys
import unicodedata
from pathlib import Path

import pytest

from scaffold.cli.main import main
from scaffold.printable import json_text, printable, printable_lines

ROOT = Path(__file__).resolve().parents[2]

TRICKS = "\x1b]0;owned\x07 \x00 \x9b31m \u202eslip\u202c \u2066i\u2069 \u200e\u200f\u061c\u200b"
"""A title, NUL, a colour by C1, and marks that turn text or cannot be seen."""

WRITERS = {
    "scaffold/cli/terminal.py": "the one way out",
    "scaffold/cli/interactive/progress.py": "tqdm draws a bar of counts on standard error",
    "scaffold/cli/interactive/screen.py": "prompt_toolkit draws the questions",
    "scaffold/cli/verbs/new.py": "asks whether there is a terminal",
    "scaffold/cli/reports.py": "asks whether there is a terminal",
    "scaffold/check/cache/runs.py": "asks whether there is a terminal",
    "scaffold/cli/status_line.py": "draws one line again and again",
    "scaffold/cli/verbs/smoke.py": "its reporters write as they go",
    "scaffold/generate/templates/foreign_worker.py": "its output is for the parent",
    "scaffold/ament/xml/validate.py": "a process of its own; its output is JSON for the parent",
    "scaffold/check/cluster/batch_process.py": "a process of its own; its output is for the parent",
    "scaffold/smoke/probe/main.py": "a process of its own; its output is JSON for the parent",
}
"""The modules that mention standard output or error, and why they may."""


def test_control_characters_are_escaped() -> None:
    for number in range(sys.maxunicode + 1):
        character = chr(number)
        if unicodedata.category(character) in {"Cc", "Cf", "Cs", "Zl", "Zp"}:
            assert character not in printable(f"a{character}b"), hex(number)
            if character not in "\n\t":
                assert character not in printable_lines(f"a{character}b"), hex(number)


def test_letters_of_every_language_are_kept() -> None:
    text = "Größe 速度 скорость سرعة ⚙ 'a\"b'"

    assert printable(text) == text


def test_undecodable_byte_is_escaped() -> None:
    assert printable("caf\udce9") == "caf\\xe9"


def test_json_has_no_control_characters() -> None:
    text = json_text({TRICKS: "\x7f"})

    assert printable_lines(text) == text
    assert json.loads(text) == {TRICKS: "\x7f"}


def test_every_module_writes_through_the_terminal_module() -> None:
    mentions = {
        path.relative_to(ROOT).as_posix()
        for path in (ROOT / "scaffold").rglob("*.py")
        if any(_is_direct_output(node) for node in ast.walk(ast.parse(path.read_text())))
    }

    assert mentions <= set(WRITERS), "write with scaffold.cli.terminal instead"


def _is_direct_output(node: ast.AST) -> bool:
    match node:
        case ast.Call(func=ast.Name(id="print")):
            return True
        case ast.Attribute(value=ast.Name(id="sys"), attr=name):
            return name in {"stdout", "stderr", "__stdout__", "__stderr__"}
    return False


def _package(tmp_path: Path) -> Path:
    assert main(["new", "talker", "--destination-directory", str(tmp_path)]) == 0
    return tmp_path / "talker"


def _shown(capsys: pytest.CaptureFixture[str]) -> str:
    captured = capsys.readouterr()
    text = captured.out + captured.err
    assert printable_lines(text) == text
    return text


def test_escapes_in_file_names_and_messages_of_a_report(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    package = _package(tmp_path)
    (package / "talker" / f"x{TRICKS.replace(chr(0), '')}.py").write_text(f"'{TRICKS[6:]}' +\n")
    manifest = package / "package.xml"
    manifest.write_text(manifest.read_text().replace("Apache-2.0", "TODO\u202e"))
    capsys.readouterr()

    assert main(["check", str(package)]) == 1
    assert "\\u202e" in _shown(capsys)

    assert main(["check", "--format", "json", str(package)]) == 1
    assert "\\u202e" in _shown(capsys)


def test_escapes_in_keys_of_a_record(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    package = _package(tmp_path)
    record = package / ".ros2-scaffold.json"
    entries = json.loads(record.read_text())
    entries["answers"][f"key{TRICKS}"] = 1
    record.write_text(json.dumps(entries))
    capsys.readouterr()

    assert main(["update", str(package)]) == 0

    assert "note: the templates no longer ask for key\\x1b]0;owned\\x07" in _shown(capsys)


def test_escapes_in_arguments_quoted_by_an_error(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit, match="2"):
        main(["check", "--format", TRICKS])
    assert "\\x1b]0;owned\\x07" in _shown(capsys)

    assert main(["check", f"nowhere{TRICKS}"]) == 2
    assert "\\x1b]0;owned\\x07" in _shown(capsys)


def test_escapes_in_summaries_of_user_templates(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    template = tmp_path / "templates" / "extras" / "odd"
    template.mkdir(parents=True)
    (template / "template.yaml").write_text(f"summary: {json.dumps(TRICKS)}\n")

    assert main(["templates", "list", str(tmp_path)]) == 0

    assert "\\x1b]0;owned\\x07" in _shown(capsys)


def test_escapes_in_interface_definitions(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    where = ["--destination-directory", str(tmp_path)]
    assert main(["new", "odd_msgs", "--add", "message:Odd fields='string s'", *where]) == 0
    definition = tmp_path / "odd_msgs" / "msg" / "Odd.msg"
    definition.write_text(f"string s '{TRICKS}'\n")
    capsys.readouterr()

    main(["interfaces", "odd_msgs/Odd", "--workspace", str(tmp_path)])

    assert "\\x1b]0;owned\\x07" in _shown(capsys)
