"""The configuration of a project: where it is found, which keys it has, and their effects."""

from __future__ import annotations

import json
import shutil
import subprocess
import sys
from pathlib import Path

import jsonschema
import pytest

from scaffold.cli.main import main
from scaffold.configuration import config, keys

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

ROOT = Path(__file__).parents[2]
FLAWED = "import os\nx = 1;\n"


@pytest.fixture(scope="module")
def generated(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a directory with two generated packages."""
    top = tmp_path_factory.mktemp("generated")
    for name in ("talker", "listener"):
        assert main(["new", name, "--destination-directory", str(top)]) == 0
    return top


@pytest.fixture
def workspace(
    own_cache: Path, generated: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> Path:
    """Return the current directory, with two packages without findings."""
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path / "config"))
    monkeypatch.setenv("XDG_CACHE_HOME", str(own_cache))
    top = tmp_path / "workspace"
    shutil.copytree(generated, top)
    monkeypatch.chdir(top)
    return top


def check(capsys: pytest.CaptureFixture[str], *words: str) -> tuple[int, str]:
    capsys.readouterr()
    code = main(["check", *words])
    captured = capsys.readouterr()
    assert captured.err == ""
    return code, captured.out


def depend_on(package: Path, name: str) -> None:
    manifest = package / "package.xml"
    dependency = f"  <exec_depend>{name}</exec_depend>\n  <test_depend"
    manifest.write_text(manifest.read_text().replace("  <test_depend", dependency, 1))


def error_line(capsys: pytest.CaptureFixture[str], *words: str) -> str:
    capsys.readouterr()
    assert main([*(words or ("check",))]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    return line


def test_pyproject_table_is_equivalent_to_own_file(
    workspace: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (workspace / "talker" / "talker" / "extra.py").write_text(FLAWED)
    assert check(capsys, "talker")[0] == 1
    (workspace / "pyproject.toml").write_text('[tool.ros2-scaffold.check]\nselect = ["CM"]\n')
    assert check(capsys, "talker") == (0, "1 package, 13 files for Jazzy: no findings\n")
    (workspace / "talker" / "pyproject.toml").write_text("[tool.black]\nline-length = 99\n")
    assert check(capsys, "talker")[0] == 0, "a pyproject.toml without the table does not count"
    (workspace / "talker" / "ros2-scaffold.toml").write_text('[check]\nselect = ["F"]\n')
    assert check(capsys, "talker")[0] == 1, "the nearest one counts"


def test_two_configuration_files_in_a_directory_are_rejected(
    workspace: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (workspace / "pyproject.toml").write_text("[tool.ros2-scaffold]\n")
    (workspace / "ros2-scaffold.toml").write_text("")
    assert f"{workspace}: both ros2-scaffold.toml and [tool.ros2-scaffold] in " in error_line(
        capsys
    )


def test_pyproject_of_other_tools_may_be_invalid(
    workspace: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (workspace / "pyproject.toml").write_text("this is not TOML")
    assert check(capsys)[0] == 0
    (workspace / "pyproject.toml").write_text('[project.scripts]\nros2-scaffold = "a:b"\n')
    (workspace.parent / "ros2-scaffold.toml").write_text("[check\n")
    assert "invalid TOML" in error_line(capsys), "the search goes on above it"


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("[checks]\n", "unknown table [tool.ros2-scaffold.checks]; did you mean 'check'?"),
        ("[check]\nexlude = []\n", "[tool.ros2-scaffold.check] has no key 'exlude'; did you mean"),
        ("[check]\nexclude = 'a'\n", "check.exclude must be a list of strings"),
        ("[check]\nexclude = ['../a']\n", "check.exclude has '../a': a pattern is a path below"),
        ("[check]\nexclude = ['[']\n", "check.exclude has '[': its '[' is never closed"),
        ("[check]\nexclude = ['[a]/b[!c']\n", "check.exclude has '[a]/b[!c': its '[' is never"),
        ("[check]\nexclude = ['/a']\n", "check.exclude has '/a': a pattern is a path below"),
        (
            "[check]\nstyle = 'onw'\n",
            "check.style has 'onw', which is not a choice; did you mean 'own'?",
        ),
        ("[check]\nstyle = ['own']\n", "check.style has ['own'], which is not a choice; "),
        (
            "[check]\nseverity = 'error'\n",
            "check.severity must be a table of rules with severities",
        ),
        (
            "[check.severity]\nPX020 = 'warn'\n",
            (
                "check.severity has 'warn' for 'PX020', which is not a severity; "
                "did you mean 'warning'?"
            ),
        ),
        (
            "[check.severity]\nPX020 = 1\n",
            "check.severity has 1 for 'PX020', which is not a severity",
        ),
        ("[check.severity]\nPX999 = 'info'\n", "severity: no rule has the code 'PX999'; did you "),
        (
            "[tool.ros2-scaffold.new]\nlicence = 'MIT'\n",
            "[new]: 'licence' is not a question of the templates; did you mean license?",
        ),
    ],
)
def test_invalid_configuration_is_one_error_line(
    workspace: Path, capsys: pytest.CaptureFixture[str], text: str, message: str
) -> None:
    path = workspace / "pyproject.toml"
    path.write_text(text.replace("[check", "[tool.ros2-scaffold.check"))
    for words in (("check",), ("config",)):
        line = error_line(capsys, *words)
        assert line.startswith(f"ros2-scaffold: error: {path}: ")
        assert message in line
    if not {"PX999", "licence"} & {*text.replace("'", " ").split()}:
        assert message in error_line(capsys, "rules"), "every verb reads the configuration"


def test_exclude_is_rejected_in_user_configuration(
    workspace: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = workspace.parent / "config" / "ros2-scaffold" / "config.toml"
    path.parent.mkdir(parents=True)
    path.write_text('[check]\nexclude = ["talker"]\n')
    assert "check.exclude is only allowed in the file of a project" in error_line(capsys)


def test_configured_severity_decides_the_exit_code(
    workspace: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (workspace / "talker" / "talker" / "extra.py").write_text(
        "import scipy\n\n\ndef main():\n    scipy.pi\n"
    )
    words = ("--select", "PX020", "--format", "json")
    configuration = workspace / "ros2-scaffold.toml"
    for text, severity, code in (
        ("", "error", 1),
        ('PX020 = "warning"\n', "warning", 1),
        ('import-undeclared = "info"\n', "info", 0),
        ('PX = "info"\nPX02 = "warning"\n', "warning", 1),
    ):
        configuration.write_text(f"[check.severity]\n{text}")
        for _ in range(2):  # the second one is remembered
            got, output = check(capsys, *words)
            (finding,) = json.loads(output)["diagnostics"]
            assert (finding["severity"], got) == (severity, code)


def test_excluded_packages_and_files_are_skipped_and_counted(
    workspace: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    for name in ("talker", "listener"):
        (workspace / name / name / "extra.py").write_text(FLAWED)
    depend_on(workspace / "listener", "talker")
    shutil.move(workspace / "talker", workspace / "third_party" / "talker")
    configuration = workspace / "ros2-scaffold.toml"
    words = ("--select", "F,PX")
    configuration.write_text('[check]\nexclude = ["third_party/*"]\n')
    code, output = check(capsys, *words)
    *findings, note, summary = output.splitlines()
    assert code == 1
    assert [line.split()[0] for line in findings] == ["listener/listener/extra.py:1:1:"]
    assert note == "excluded by ros2-scaffold.toml: 1 package"
    assert summary.startswith("1 package, 13 files for Jazzy: ")
    configuration.write_text('[check]\nexclude = ["./third_party/", "listener/*/extra.py"]\n')
    for _ in range(2):
        assert check(capsys, *words) == (
            0,
            """\
excluded by ros2-scaffold.toml: 1 package, 1 file
1 package, 12 files for Jazzy: no findings
""",
        )
    code, output = check(capsys, *words, "third_party/talker", "listener/listener/extra.py")
    assert (code, output.splitlines()[0]) == (
        0,
        "excluded by ros2-scaffold.toml: 1 package, 1 file",
    )
    assert main(["check", "--fix", *words]) == 0
    assert (workspace / "listener" / "listener" / "extra.py").read_text() == FLAWED


def test_change_in_excluded_package_invalidates_the_cache(
    own_cache: Path, workspace: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    depend_on(workspace / "listener", "talker")
    (workspace / "ros2-scaffold.toml").write_text('[check]\nexclude = ["talker"]\n')
    before = check(capsys)
    depend_on(workspace / "talker", "listener")
    after = check(capsys)
    shutil.rmtree(own_cache)
    assert check(capsys) == after
    assert (before[0], after[0]) == (0, 1), "the two depend on each other now"


def test_own_style_follows_the_linters_that_the_package_runs(
    workspace: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (workspace / "talker" / "talker" / "extra.py").write_text(FLAWED)
    (workspace / "ros2-scaffold.toml").write_text('[check]\nstyle = "own"\n')
    runs_linters = check(capsys, "talker")
    assert "F401" in runs_linters[1]
    cmake = workspace / "talker" / "CMakeLists.txt"
    manifest = workspace / "talker" / "package.xml"
    for path, word in ((cmake, "ament_lint_auto"), (manifest, "ament_lint_")):
        lines = path.read_text().splitlines(keepends=True)
        path.write_text("".join(line for line in lines if word not in line))
    assert "F401" not in check(capsys, "talker")[1]
    (workspace / "ros2-scaffold.toml").unlink()
    assert "F401" in check(capsys, "talker")[1]


def test_patterns_are_relative_to_the_file_or_to_packages(
    workspace: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    for name in ("talker", "listener"):
        (workspace / name / name / "extra.py").write_text(FLAWED)
    words = ("--select", "F", "--no-types", "--quiet")
    configuration = workspace / "ros2-scaffold.toml"
    for pattern, reported in (
        ("talker/talker/extra.py", ["listener"]),  # from the file
        ("./talker/*", ["listener"]),
        ("listener/extra.py", ["talker"]),  # from the package
        ("*/extra.py", []),
        ("extra.py", ["listener", "talker"]),
    ):
        configuration.write_text(f'[check.per-path-ignores]\n"{pattern}" = ["F401"]\n')
        code, output = check(capsys, *words)
        result = [line.partition("/")[0] for line in output.splitlines()]
        assert (result, code) == (reported, 1 if reported else 0), pattern


def test_line_length_applies_where_no_test_configures_it(
    workspace: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    for name in ("talker", "listener"):
        (workspace / name / name / "extra.py").write_text(f"x = '{'x' * 101}'\n")
    cmake = workspace / "talker" / "CMakeLists.txt"
    cmake.write_text(cmake.read_text().replace("ament_lint_auto_find_test_dependencies", "foo"))
    for length, reported in ((98, ["listener", "talker"]), (110, ["listener"])):
        (workspace / "ros2-scaffold.toml").write_text(f"[check]\nline-length = {length}\n")
        output = check(capsys, "--select", "E501", "--quiet")[1]
        assert [line.partition("/")[0] for line in output.splitlines()] == reported
    output = check(capsys, "--select", "E501", "--quiet", "--reference-config")[1]
    assert len(output.splitlines()) == 2


def test_license_not_in_the_allowed_list_is_reported(
    workspace: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    configuration = workspace / "ros2-scaffold.toml"
    configuration.write_text('[check]\nlicenses = ["MIT", "BSD-3-Clause"]\n')
    code, output = check(capsys, "talker", "--select", "SC008", "--quiet")
    assert (code, output.count("SC008")) == (1, 1)
    message = "license 'Apache-2.0' is not allowed here; allowed: MIT, BSD-3-Clause"
    assert message in output
    assert output.startswith("talker/package.xml:")
    configuration.write_text('[check]\nlicenses = ["MIT", "Apache-2.0"]\n')
    assert check(capsys, "talker", "--select", "SC008", "--quiet") == (0, "")
    manifest = workspace / "talker" / "package.xml"
    manifest.write_text(manifest.read_text().replace("Apache-2.0", "Apache License 2.0"))
    assert check(capsys, "talker", "--select", "SC008", "--quiet") == (0, "")


def test_configured_dependencies_need_no_declaration(
    workspace: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    code = "import scipy\nimport torch\nimport tf2_ros\n\nprint(scipy, torch, tf2_ros)\n"
    (workspace / "talker" / "talker" / "extra.py").write_text(code)
    words = ("talker", "--select", "import-undeclared", "--quiet")
    before = check(capsys, *words)[1]
    assert [name for name in ("scipy", "torch", "tf2_ros") if f"'{name}'" in before] == [
        *("scipy", "torch", "tf2_ros")
    ]
    configuration = workspace / "ros2-scaffold.toml"
    names = '["python3-scipy", "torch", "tf2_ros"]'
    configuration.write_text(f"[check]\nimplicit-dependencies = {names}\n")
    assert check(capsys, *words) == (0, "")
    configuration.write_text('[check]\nimplicit-dependencies = ["torch"]\n')
    after = check(capsys, *words)[1]
    assert len(after.splitlines()) == 2


@pytest.mark.parametrize(
    ("line", "message"),
    [
        (
            "distribution = 'jazy'",
            "check.distribution is wrong: no distribution 'jazy'; did you mean 'jazzy'?",
        ),
        (
            "distribution = 'jazzy, lyrical'",
            '\'jazzy, lyrical\' is more than one distribution; write a list: ["jazzy", "lyrical"]',
        ),
        ("distribution = []", "check.distribution must be one of `humble`, `jazzy`, "),
        (
            "default-excludes = ['vendor']",
            "check.default-excludes has 'vendor', which is not a choice; did you mean",
        ),
        ("line-length = '99'", "check.line-length must be a number from 1 to 10000"),
        ("licences = ['MIT']", "[check] has no key 'licences'; did you mean 'licenses'?"),
        ("implicit-dependencies = 'x'", "check.implicit-dependencies must be a list of strings"),
    ],
)
def test_invalid_values_are_explained(
    workspace: Path, capsys: pytest.CaptureFixture[str], line: str, message: str
) -> None:
    (workspace / "ros2-scaffold.toml").write_text(f"[check]\n{line}\n")
    assert message in error_line(capsys)


def test_underscore_in_table_name_is_explained(
    workspace: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (workspace / "pyproject.toml").write_text('[tool.ros2_scaffold.check]\nselect = ["PX"]\n')
    message = "unknown table [tool.ros2_scaffold]; did you mean [tool.ros2-scaffold]?"
    assert message in error_line(capsys)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("contnet = []", "unknown key 'contnet'; did you mean 'content'?"),
        ("selct = []", "unknown key 'selct'; did you mean 'select' in [check]?"),
        ("select = []", "'select' must be in the table [check]"),
        ("check = 5", "'check' must be a table: [check]"),
        ("xyzzy = 5", "unknown key 'xyzzy'; keys are in tables such as [check]"),
        ("[check]\nignore = ['']", "check.ignore has an empty string"),
    ],
)
def test_misplaced_keys_and_empty_strings_are_explained(
    workspace: Path, capsys: pytest.CaptureFixture[str], text: str, message: str
) -> None:
    (workspace / "ros2-scaffold.toml").write_text(f"{text}\n")
    assert message in error_line(capsys)


def test_config_shows_each_value_and_its_file(
    workspace: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    user = workspace.parent / "config" / "ros2-scaffold" / "config.toml"
    user.parent.mkdir(parents=True)
    user.write_text('content = ["own"]\n[check]\nselect = ["CM"]\nignore = ["PX"]\n')
    (user.parent / "own" / "rules").mkdir(parents=True)
    project = workspace / "talker" / "pyproject.toml"
    project.write_text(
        '[tool.ros2-scaffold.check]\nselect = ["F"]\n'
        '[tool.ros2-scaffold.check.severity]\nF401 = "info"\n[tool.ros2-scaffold.new]\nrate = 2.5\n'
    )
    capsys.readouterr()
    assert main(["config", "talker/package.xml", "--format", "json"]) == 0
    rows = json.loads(capsys.readouterr().out)
    assert [(row["key"], row["value"], row["origin"]) for row in rows] == [
        ("content", [str(user.parent / "own")], str(user)),
        ("check.select", ["F"], str(project)),
        ("check.ignore", ["PX"], str(user)),
        ("check.per-path-ignores", {}, None),
        ("check.severity", {"F401": "info"}, str(project)),
        ("check.exclude", [], None),
        ("check.default-excludes", [*keys.FOREIGN], None),
        ("check.style", "all", None),
        ("check.line-length", 99, None),
        ("check.licenses", [], None),
        ("check.implicit-dependencies", [], None),
        ("check.distribution", "jazzy", None),
        ("new.rate", 2.5, str(project)),
    ]
    assert main(["config", "talker"]) == 0
    shown = capsys.readouterr().out.splitlines()
    assert [line.rpartition("  # ")[2] for line in shown] == [
        row["origin"] or "default" for row in rows
    ]
    assert shown[4].startswith('check.severity = { "F401" = "info" }  ')
    assert "nowhere: no such file or directory" in error_line(capsys, "config", "nowhere")


def test_documentation_and_schema_are_up_to_date(tmp_path: Path) -> None:
    shutil.copy(ROOT / "docs" / "configuration.md", tmp_path)
    script = ROOT / "scripts" / "document_configuration.py"
    subprocess.run([sys.executable, str(script), str(tmp_path)], check=True, cwd=ROOT)
    for name in ("configuration.md", "ros2-scaffold.schema.json"):
        assert (ROOT / "docs" / name).read_text() == (tmp_path / name).read_text(), "`make docs`"
    assert all(f"`{key.path}`" in (tmp_path / "configuration.md").read_text() for key in keys.KEYS)


@pytest.mark.parametrize(
    ("text", "is_valid"),
    [
        (
            (ROOT / "docs" / "configuration.md").read_text().split("```")[1].removeprefix("toml\n"),
            True,
        ),
        ("", True),
        ("[checks]\n", False),
        ("[check]\nstyle = 'onw'\n", False),
        ("[check]\nselect = 'PX'\n", False),
        ("[check]\nexlude = []\n", False),
        ("[check.severity]\nPX020 = 'warn'\n", False),
        ("[check]\ndefault-excludes = ['ignore']\n", False),
        ("[check]\nline-length = 0\n", False),
        ("[check]\nline-length = true\n", False),
        ("[check]\nlicenses = 'MIT'\n", False),
        ("[check]\nimplicit-dependencies = [1]\n", False),
        ("[check]\ndistribution = 'humble'\n", True),
        ("[check]\ndistribution = ['jazzy', 'lyrical']\n", True),
        ("[check]\ndistribution = ['noetic']\n", False),
        ("[check]\ndistribution = []\n", False),
        ("[check.per-path-ignores]\na = 'PX'\n", False),
        ("content = ['']\n", False),
        ("contnet = []\n", False),
    ],
)
def test_schema_and_tool_accept_the_same_configurations(
    workspace: Path, capsys: pytest.CaptureFixture[str], text: str, *, is_valid: bool
) -> None:
    (workspace / "ros2-scaffold.toml").write_text(text)
    validator = jsonschema.Draft7Validator(keys.schema())
    jsonschema.Draft7Validator.check_schema(keys.schema())
    assert validator.is_valid(tomllib.loads(text)) is is_valid
    assert main(["config"]) == (0 if is_valid else 2)
    capsys.readouterr()


def test_unset_value_is_the_default() -> None:
    assert config.Config({}).value("check.style") == "all"
