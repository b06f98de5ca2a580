"""Python style and docstrings: findings equal those of the real linters, file by file."""

from __future__ import annotations

import os
import sys
import tokenize
from collections.abc import Mapping, Sequence
from io import StringIO
from pathlib import Path

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from scaffold.ament import StyleCheck, codes, ruff, verdict
from scaffold.ament import files as selection
from scaffold.ament.finding import FLAKE8, PEP257
from scaffold.ament.pep257 import form as docstrings
from scaffold.ament.pep257 import reference
from scaffold.ament.python_text import fstrings
from scaffold.ament.python_text.tokens import FSTRING_END, FSTRING_MIDDLE, FSTRING_START
from scaffold.ament.settings import Settings
from scaffold.check.fixes import fixer
from scaffold.diagnostic import Diagnostic, Severity
from scaffold.errors import EnvironmentMissingError
from scaffold.files import cache
from scaffold.model.package import Package
from tests import oracles
from tests.ament import style_cases

Found = set[tuple[str, int, str]]

on_python_3_12 = pytest.mark.skipif(
    sys.version_info < (3, 12), reason="the linters see f-strings as on Jazzy only on its Python"
)


def ours(package: Package) -> Found:
    return {(d.location.path, d.location.line, d.code) for d in check(package)}


def check(package: Package) -> list[Diagnostic]:
    return StyleCheck([package]).diagnostics(package)


def theirs(directory: Path) -> Found:
    """Return the findings of both linters; a file that does not parse counts once."""
    findings = oracles.ament_flake8(directory) | oracles.ament_pep257(directory)
    return {(finding.path, finding.line, finding.code) for finding in findings if finding.line}


def assert_same(directory: Path, cases: Sequence[str]) -> None:
    """Check all cases as files of one directory, and list those with different findings."""
    names = [f"case_{at:04}.py" for at in range(len(cases))]
    for name, case in zip(names, cases, strict=True):
        (directory / name).write_bytes(case.encode())
    real, own = theirs(directory), ours(Package.at(directory))
    differing = {
        case: (
            sorted(item[1:] for item in real - own if item[0] == name),
            sorted(item[1:] for item in own - real if item[0] == name),
        )
        for name, case in zip(names, cases, strict=True)
    }
    assert {case: both for case, both in differing.items() if any(both)} == {}


# -- the same verdict


@pytest.mark.parametrize(
    "group",
    [
        "WHITESPACE_AND_STATEMENTS",
        "LINES_AND_NOQA",
        "CONTINUATION_LINES",
        "NAMES",
        "IMPORTS",
        "BUILTINS",
        "DEFINITIONS",
    ],
)
def test_same_findings(tmp_path: Path, group: str) -> None:
    assert_same(tmp_path, getattr(style_cases, group))


def test_same_findings_in_functions(tmp_path: Path) -> None:
    statements = [
        *style_cases.WHITESPACE_AND_STATEMENTS[:100],
        *style_cases.CONTINUATION_LINES,
    ]
    indented = ["".join(f"    {line}\n" for line in item.splitlines()) for item in statements]
    assert_same(tmp_path, [f"def f():\n{body}" for body in indented if "\n    from " not in body])


def test_same_findings_in_calls(tmp_path: Path) -> None:
    calls = style_cases.COMPREHENSIONS
    assert_same(
        tmp_path, [f"async def f(y, z, x, a, b, k):\n    return ({item})\n" for item in calls]
    )


def test_same_findings_in_docstrings(tmp_path: Path) -> None:
    bodies, places = style_cases.DOCSTRINGS, style_cases.DOCSTRING_PLACES
    cases = [
        places[at].format(body)
        for number, body in enumerate(bodies)
        for at in {0, 5, number % len(places), (number * 7 + 3) % len(places)}
        if 'f"""' not in body
    ]
    modules = [
        style_cases.MODULE_DOCSTRING_PLACES[number % 5].format(body.replace("\n    ", "\n"))
        for number, body in enumerate(bodies)
        if 'f"""' not in body
    ]
    assert_same(tmp_path, cases + modules)


@on_python_3_12
def test_same_findings_in_new_syntax(tmp_path: Path) -> None:
    assert_same(tmp_path, style_cases.PYTHON_3_12)


BROKEN = (
    "def f(:\n",
    "try:\n    pass\nfinally:\n\t        if 1:\n            pass\n",
    "x = (1,\n",
    "if x:\nprint(1)\n",
    "x = 1\n  y = 2\n",
    "x = '\n",
    "print 'x'\n",
    "'''\n",
    "class\n",
    "x = 1\n\n\nreturn = 2\n",
)


def test_unparsable_file_is_reported_once(tmp_path: Path) -> None:
    assert_same(tmp_path, BROKEN)


def test_newer_python_syntax_is_no_error() -> None:
    package = Package.of({"a.py": "type Name = int\n"})
    assert "E999" not in {d.code for d in check(package)}


def test_syntax_after_python_3_12_is_an_error() -> None:
    package = Package.of({"a.py": "def f[T = int](x):\n    return x\n"})
    (finding,) = check(package)
    assert (finding.code, finding.severity, finding.location.line) == ("E999", Severity.ERROR, 1)


def test_exceptions_of_python_2_are_not_sent_to_python_3_14() -> None:
    package = Package.of({"a.py": "try:\n    x = 1\nexcept ValueError, e:\n    pass\n"})
    (finding,) = [d for d in check(package) if d.code == "E999"]
    assert "except A as b:" in finding.message
    assert "3.14" not in finding.message


# -- which files


def test_selected_files(tmp_path: Path) -> None:
    bad = b"x=1\n\n\ndef f():\n    '''does'''\n"
    files = [
        "a.py",
        "sub/b.py",
        "_private/c.py",
        "sub/_x/d.py",
        "off/e.py",
        "off/deep/f.py",
        "g.pyi",
    ]
    for name in files:
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_bytes(bad)
    (tmp_path / "off/AMENT_IGNORE").touch()
    assert ours(Package.at(tmp_path)) == theirs(tmp_path)
    both = FLAKE8 | PEP257
    chosen = selection.select([*files, "off/AMENT_IGNORE"])
    assert chosen == {"a.py": both, "sub/b.py": both, "off/e.py": PEP257, "off/deep/f.py": PEP257}


def test_dangling_symlinks_are_unreadable(tmp_path: Path) -> None:
    (tmp_path / "a.py").symlink_to("gone.py")
    real = {(finding.path, finding.code) for finding in oracles.ament_flake8(tmp_path)}
    assert real == {("a.py", "E902")}
    (item,) = check(Package.at(tmp_path))
    assert (item.location.path, item.location.line, item.code) == ("a.py", 1, "E902")
    assert item.message == "the file cannot be read: broken symbolic link"


def test_user_configuration_of_ruff_is_ignored(tmp_path: Path) -> None:
    (tmp_path / "a.py").write_text("import os\n")
    (tmp_path / "ruff.toml").write_text('exclude = ["*.py"]\nlint.ignore = ["ALL"]\n')
    assert ours(Package.at(tmp_path)) == {("a.py", 1, "F401")}


# -- diagnostics


def test_locations_names_and_severities() -> None:
    package = Package.of({"pkg/a.py": "import os\nx = undefined;\n", "b.py": "y = 'é' + f(a ,2)\n"})
    diagnostics = {d.code: d for d in check(package)}
    assert set(diagnostics) == {"F401", "F821", "E703", "E203", "E231"}
    assert diagnostics["F821"].severity is Severity.ERROR
    assert diagnostics["F401"].severity is Severity.WARNING
    assert diagnostics["F401"].name == "unused-import"
    assert diagnostics["F821"].location[:3] == ("pkg/a.py", 2, 5)
    assert diagnostics["E203"].location[:3] == ("b.py", 1, 14)


@pytest.mark.parametrize(
    ("text", "code", "severity"),
    [
        ("print(version)\n", "F821", Severity.ERROR),
        ("exec(open('version.py').read())\nprint(version)\n", "F821", Severity.WARNING),
        ("exec('', {})\nprint(version)\n", "F821", Severity.ERROR),
        ("if 'version' in globals():\n    print(version)\n", "F821", Severity.WARNING),
        ("if 'other' in globals():\n    print(version)\n", "F821", Severity.ERROR),
        ("__all__ = ['hello']\n", "F822", Severity.ERROR),
        (
            "__all__ = ['hello']\n\n\ndef __getattr__(name):\n    return name\n",
            "F822",
            Severity.WARNING,
        ),
    ],
)
def test_undefined_name_is_a_warning_if_it_may_exist_at_run_time(
    text: str, code: str, severity: Severity
) -> None:
    severities = [d.severity for d in check(Package.of({"a.py": text})) if d.code == code]
    assert severities == [severity]


def test_every_code_has_a_name() -> None:
    names = [item.name for item in codes.STYLE.values()]
    assert len(set(names)) == len(names)
    assert list(codes.CODES) == sorted(codes.CODES)
    assert all(item.summary[-1] != "." for item in codes.CODES.values())


FIXED = {
    'x = "a"\n': "x = 'a'\n",
    "x = 1 \n": "x = 1\n",
    "x = 1": "x = 1\n",
    "import os\nx = 1\n": "x = 1\n",
    'x = [ 1,2 ]\r\ny = "é"\r\n': "x = [1, 2]\r\ny = 'é'\r\n",
    "import sys\nimport abc\nprint(sys, abc)\n": "import abc\nimport sys\nprint(sys, abc)\n",
    "from os import walk, path\nwalk(path)\n": "from os import path, walk\nwalk(path)\n",
    "import numpy\nimport os\nprint(os, numpy)\n": "import os\n\nimport numpy\nprint(os, numpy)\n",
}


@pytest.mark.parametrize("before", FIXED)
def test_fixes_of_style(before: str) -> None:
    fixed = fixer.fix(Package.of({"a.py": before.encode()}), check)
    assert fixed.changed["a.py"].decode() == FIXED[before]
    assert check(fixed.package) == []


@pytest.mark.parametrize(
    "kept",
    [
        "import sys  # first\nimport abc\nprint(sys, abc)\n",
        "import sys\n# second\nimport abc\nprint(sys, abc)\n",
    ],
)
def test_imports_with_comments_are_not_sorted(kept: str) -> None:
    assert fixer.fix(Package.of({"a.py": kept}), check).changed == {}


# -- cache


def test_cached_files_need_no_ruff(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    package = Package.of({"a.py": "x=1\n", "b.py": "y = 2\n"})
    first = check(package)

    def refuse(*_: object) -> None:
        raise AssertionError("ruff was started")

    monkeypatch.setattr(ruff, "Run", refuse)
    assert check(package) == first
    with pytest.raises(AssertionError, match="ruff was started"):
        check(Package.of({"a.py": "x=2\n"}))


def test_broken_cache_is_ignored(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    package = Package.of({"a.py": "x=1\n"})
    first = check(package)
    (entry,) = [path for path in tmp_path.rglob("*") if path.is_file()]
    for content in (b"", b"nonsense", entry.read_bytes()[:-3]):
        entry.write_bytes(content)
        assert check(package) == first


def test_unwritable_cache_is_ignored(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "file").touch()
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "file"))
    assert [d.code for d in check(Package.of({"a.py": "x=1\n"}))] == ["E225"]


def test_cache_can_be_disabled(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    monkeypatch.setenv(cache.SWITCH, "1")
    check(Package.of({"a.py": "x=1\n"}))
    assert list(tmp_path.iterdir()) == []


# -- ruff


def test_missing_ruff_is_one_error_line(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(cache.SWITCH, "1")
    monkeypatch.setattr(ruff, "_FOUND", [os.devnull])
    with pytest.raises(EnvironmentMissingError, match="ruff cannot be started"):
        check(Package.of({"a.py": "x=1\n"}))


def test_many_files_are_split_over_several_runs(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(cache.SWITCH, "1")
    monkeypatch.setattr(ruff, "MAX_ARGUMENTS", 200)
    package = Package.of({f"module_{at}.py": f"import os\nx = {at}\n" for at in range(12)})
    assert len(check(package)) == 12


def test_several_packages_in_one_run() -> None:
    packages = [Package.of({"a.py": f"import {name}\n"}) for name in ("os", "abc", "ast")]
    style = StyleCheck(packages)
    result = [style.diagnostics(package) for package in reversed(packages)]
    assert [d.message.split()[0] for (d,) in result] == ["'ast'", "'abc'", "'os'"]


# -- reference


def test_reference_mode_agrees() -> None:
    files: Mapping[str, str] = {
        f"f{at}.py": f"def f(a):\n    {body}\n" for at, body in enumerate(style_cases.DOCSTRINGS)
    }
    assert list(reference.differences([Package.of(files)])) == []


def test_reference_mode_reports_differences(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(docstrings, "check", lambda _: iter(()))
    package = Package.of({"a.py": 'def f():\n    """do"""\n'})
    diagnostics = [difference for _, difference in reference.differences([package])]
    assert [(d.line, d.code, d.only_reference) for d in diagnostics] == [
        (2, "D400", True),
        (2, "D403", True),
        (2, "D415", True),
    ]


# -- f-strings


def test_f_strings_are_tokenized_as_in_python_3_12() -> None:
    string = "f'a{{b {x !r:>{w}.2} {y=}' + f''"
    whole = tokenize.TokenInfo(tokenize.STRING, string[:-6], (1, 0), (1, 26), string)
    parts = [(item.type, item.string, item.start[1]) for item in fstrings.open_up([whole])]
    op, name = tokenize.OP, tokenize.NAME
    assert parts == [
        (FSTRING_START, "f'", 0),
        (FSTRING_MIDDLE, "a{", 2),
        (FSTRING_MIDDLE, "b ", 5),
        (op, "{", 7),
        (name, "x", 8),
        (op, "!", 10),
        (name, "r", 11),
        (op, ":", 12),
        (FSTRING_MIDDLE, ">", 13),
        (op, "{", 14),
        (name, "w", 15),
        (op, "}", 16),
        (FSTRING_MIDDLE, ".2", 17),
        (op, "}", 19),
        (FSTRING_MIDDLE, " ", 20),
        (op, "{", 21),
        (name, "y", 22),
        (op, "=", 23),
        (op, "}", 24),
        (FSTRING_END, "'", 25),
    ]


@on_python_3_12
@pytest.mark.parametrize("text", [item for item in style_cases.PYTHON_3_12 if "{" in item])
def test_f_string_tokens_equal_those_of_python(text: str) -> None:
    tokens = list(tokenize.generate_tokens(StringIO(text).readline))
    strings: list[list[tokenize.TokenInfo]] = []
    depth = 0
    for token in tokens:
        if token.type == FSTRING_START:
            if not depth:
                strings.append([])
            depth += 1
        if depth:
            strings[-1].append(token)
        if token.type == FSTRING_END:
            depth -= 1
    lines = text.splitlines(keepends=True)
    for parts in strings:
        start, end = parts[0].start, parts[-1].end
        inside = lines[start[0] - 1 : end[0]]
        inside[-1] = inside[-1][: end[1]]
        inside[0] = inside[0][start[1] :]
        whole = tokenize.TokenInfo(tokenize.STRING, "".join(inside), start, end, "")
        cut = fstrings.open_up([whole])
        wanted = [item[:4] for item in parts if item.type != tokenize.NL]
        assert [item[:4] for item in cut if item.type != tokenize.NL] == wanted


# -- whatever the input


@settings(max_examples=200)
@example("\\\n#")
@given(st.text(alphabet="abl=(){}[]:,;.'\"\\#@%*+-<>! \t\n\r\x0cfdé0", max_size=80))
def test_never_fails_on_text(text: str) -> None:
    verdict.check("a.py", text.encode(), list, [Settings()])


@settings(max_examples=100)
@given(st.binary(max_size=60))
def test_never_fails_on_bytes(data: bytes) -> None:
    verdict.check("a.py", data, list, [Settings()])


@settings(max_examples=100)
@given(
    st.lists(
        st.sampled_from(
            [
                *style_cases.WHITESPACE_AND_STATEMENTS,
                *style_cases.CONTINUATION_LINES,
                *style_cases.NAMES,
                *style_cases.IMPORTS,
            ]
        ),
        max_size=6,
    )
)
def test_never_fails_on_code(parts: list[str]) -> None:
    verdict.check("a.py", "".join(parts).encode(), list, [Settings()])


def test_temporary_files_are_removed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(cache.SWITCH, "1")
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    style = StyleCheck([Package.of({"a.py": "x=1\n"})])
    assert len(list(tmp_path.iterdir())) == 1
    style.close()
    assert list(tmp_path.iterdir()) == []
    check(Package.of({"a.py": "x=1\n"}))
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("path", "text"),
    [
        (".cmake-format.py", 'with section("format"):\n    pass\n'),
        ("doc/conf.py", "tags.add('web')\n"),
        ("stubs/dns/data.py", "class Data:\n    def plain(self) -> Plain:\n        ...\n"),
    ],
)
def test_undefined_name_in_an_executed_file_is_a_warning(path: str, text: str) -> None:
    reported = check(Package.of({path: text}))
    assert [d.severity for d in reported if d.code == "F821"] == [Severity.WARNING]
