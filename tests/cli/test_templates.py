"""``templates``: listing, copying and testing templates, those of users included."""

from __future__ import annotations

from importlib.util import find_spec
from pathlib import Path

import pytest

from scaffold.cli.main import main
from scaffold.configuration import content
from scaffold.generate.templates import loading

needs_ros = pytest.mark.skipif(
    find_spec("rclpy") is None and not Path("/opt/ros").exists(),
    reason="no ROS 2: install the extra 'ros' of this project",
)


@pytest.fixture(autouse=True)
def _isolated_home(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Isolate tests from the user's settings."""
    for name in ("HOME", "XDG_CONFIG_HOME"):
        monkeypatch.setenv(name, str(tmp_path / "home"))


@pytest.fixture
def team(tmp_path: Path) -> Path:
    """Return a content directory with an extra that writes a CITATION file."""
    extra = tmp_path / "team" / "templates" / "extras" / "citation"
    extra.mkdir(parents=True)
    (extra / "template.yaml").write_text(
        "summary: A citation file\n"
        "questions:\n"
        "  year_of_paper: { default: 2026, help: when it came out }\n"
        "examples:\n"
        "  plain: { package: cited_package }\n"
    )
    (extra / "CITATION.cff.jinja").write_text("title: {{ package }}\nyear: {{ year_of_paper }}\n")
    return tmp_path / "team"


def test_all_templates_are_listed(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["templates"]) == 0
    output = capsys.readouterr().out
    for name, template in loading.load(content.roots("templates")).items():
        assert any(
            line.split() == [name, *template.summary.split()] for line in output.split("\n")
        ), name


def test_user_templates_are_listed(team: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["templates", "list", str(team)]) == 0
    assert capsys.readouterr().out == "extras:\n    citation  A citation file\n"
    assert main(["templates", "--content", str(team)]) == 0
    assert capsys.readouterr().out == "extras:\n    citation  A citation file\n"


def test_correct_template_passes(team: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["templates", "test", str(team)]) == 0
    assert capsys.readouterr().out == (
        "citation: plain, ament_cmake: ok\ncitation: plain, ament_python: ok\n"
        "2 examples, 0 failed\n"
    )


def test_template_of_a_package_with_findings_is_wrong(
    team: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    extra = team / "templates" / "extras" / "citation"
    (extra / "{{ package }}").mkdir()
    (extra / "{{ package }}" / "cite.py.jinja").write_text('{{ header }}\n\nX = "x"\n')
    assert main(["templates", "test", str(team)]) == 1
    output = capsys.readouterr().out
    assert "citation: plain, ament_cmake: failed\n    cited_package/cite.py:" in output
    assert ": Q000 " in output
    assert output.endswith("2 examples, 2 failed\n")


def test_template_that_cannot_be_rendered_is_wrong(
    team: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (team / "templates" / "extras" / "citation" / "CITATION.cff.jinja").write_text("{{ who }}\n")
    assert main(["templates", "test", str(team)]) == 1
    assert "    template 'citation/CITATION.cff.jinja'" in capsys.readouterr().out


def test_example_with_unknown_answer_is_wrong(
    team: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = team / "templates" / "extras" / "citation" / "template.yaml"
    path.write_text(path.read_text().replace("cited_package", "cited_package, year_of_papr: 2020"))
    assert main(["templates", "test", str(team)]) == 1
    assert capsys.readouterr().out.splitlines()[:2] == [
        "citation: plain, ament_cmake: failed",
        (
            "    example 'plain, ament_cmake': no template has a question 'year_of_papr'; "
            "did you mean 'year_of_paper'?"
        ),
    ]


def test_example_without_its_template_is_wrong(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["templates", "copy", "timer", str(tmp_path), "--name", "watchdog"]) == 0
    manifest = tmp_path / "templates" / "nodes" / "watchdog" / "template.yaml"
    assert '"watchdog:seconds"' in manifest.read_text()
    manifest.write_text(manifest.read_text().replace("watchdog:", "timer:"))
    capsys.readouterr()
    assert main(["templates", "test", str(tmp_path)]) == 1
    output = capsys.readouterr().out.splitlines()
    assert "watchdog: slow, ament_python: ok" in output
    where = output.index("watchdog: several, ament_python: failed")
    assert output[where + 1] == ("    example 'several, ament_python': has no watchdog, but timer")


def test_template_without_examples_is_wrong(team: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = team / "templates" / "extras" / "citation" / "template.yaml"
    path.write_text(path.read_text().partition("examples:")[0])
    assert main(["templates", "test", str(team)]) == 1
    captured = capsys.readouterr()
    assert captured.err == "note: citation has no examples: it was not tested\n"
    assert captured.out == "0 examples, 0 failed\n"


def test_directory_without_templates_is_an_error(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["templates", "test", str(tmp_path)]) == 2
    assert "it has no directory 'templates'" in capsys.readouterr().err


@pytest.mark.build
@needs_ros
def test_build_flag_builds_the_examples(team: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["templates", "test", str(team), "--build"]) == 0
    output = capsys.readouterr().out
    assert "citation: plain, ament_cmake: built\n" in output
    assert "citation: plain, ament_python: built\n" in output
    program = team / "templates" / "programs" / "cpp_broken" / "src"
    program.mkdir(parents=True)
    (program.parent / "template.yaml").write_text(
        "summary: does not compile\nbuild_types: [ament_cmake]\n"
        "questions: { program_name: { type: program, default: broken, help: its name } }\n"
        "examples: { alone: { package: broken_program } }\n"
    )
    (program / "{{ program.name }}.cpp.jinja").write_text(
        "{{ header | slashes }}\n\nint main()\n{\n  return nothing;\n}\n"
    )
    assert main(["templates", "test", str(team), "--build"]) == 1
    output = capsys.readouterr().out
    assert "cpp_broken: alone, ament_cmake: does not build\n" in output
    assert "nothing" in output


def test_single_file_of_a_template_can_be_overridden(tmp_path: Path) -> None:
    own = tmp_path / "team" / "templates" / "package"
    own.mkdir(parents=True)
    (own / "README.md.jinja").write_text("# {{ package }} of our team\n")
    (own / "NOTES.md.jinja").write_text("{{ maintainer_name }}\n")
    words = ["--maintainer-name", "Ada", "--maintainer-email", "ada@example.com"]
    words += ["--content", str(tmp_path / "team"), "--destination-directory", str(tmp_path)]
    assert main(["new", "talker", *words]) == 0
    talker = tmp_path / "talker"
    assert (talker / "README.md").read_text() == "# talker of our team\n"
    assert (talker / "NOTES.md").read_text() == "Ada\n"
    assert (talker / "package.xml").exists()


@pytest.mark.parametrize(
    ("directory", "message"),
    [
        ("nodes/publishr", "has no template.yaml, and there is no 'publishr' to override"),
        ("extras/publisher", "has no template.yaml, and there is no 'publisher' to override"),
        ("node", "templates are in package and build_types, nodes, interfaces, programs, extras"),
    ],
)
def test_override_of_unknown_template_is_rejected(
    directory: str, message: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    place = tmp_path / "templates" / directory
    place.mkdir(parents=True)
    assert main(["templates", "list", str(tmp_path)]) == 2
    assert capsys.readouterr().err == f"ros2-scaffold: error: {place}: {message}\n"


@pytest.mark.parametrize(
    ("question", "shadowed"),
    [
        ("force", "the option --force"),
        ("package_directory", "the option --package-directory"),
        ("description", "the question of package"),
        ("topic", "the question of composed_nodes"),
        ("header", "a variable"),
        ("verb", "a variable"),
        ("target", "a variable"),
    ],
)
def test_question_that_shadows_a_built_in_one_is_rejected(
    team: Path, capsys: pytest.CaptureFixture[str], question: str, shadowed: str
) -> None:
    manifest = team / "templates" / "extras" / "citation" / "template.yaml"
    asked = "topic: { type: topic, default: scan" if question == "topic" else f"{question}: {{"
    lines = manifest.read_text().replace("year_of_paper: { default: 2026", asked)
    manifest.write_text(lines.replace("{,", "{"))
    words = ("cited", "--extras", "citation", "--content", str(team))
    assert main(["new", *words, "--destination-directory", str(team)]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert f"{manifest}: the question {question!r} shadows {shadowed}" in line
    assert not (team / "cited").exists()


def test_questions_of_user_templates_are_flags(
    team: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    maintainer = ("--maintainer-name", "Ada", "--maintainer-email", "ada@example.org")
    words = ("--year-of-paper", "2030", "--extras", "citation", "--content", str(team))
    place = ("--destination-directory", str(team))
    assert main(["new", "cited", *words, *maintainer, *place]) == 0
    assert (team / "cited" / "CITATION.cff").read_text() == "title: cited\nyear: 2030\n"
    capsys.readouterr()
    with pytest.raises(SystemExit):
        main(["add", f"--content={team}", "--help"])
    assert "--year-of-paper" in capsys.readouterr().out


def test_built_in_template_can_be_copied(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    team = tmp_path / "team"
    assert main(["templates", "copy", "timer", str(team), "--name", "watchdog"]) == 0
    assert (team / "templates" / "nodes" / "watchdog" / "template.yaml").is_file()
    assert main(["templates", "copy", "package/README.md.jinja", str(team)]) == 0
    assert [*(team / "templates" / "package").iterdir()] == [
        team / "templates" / "package" / "README.md.jinja"
    ]
    assert main(["templates", "test", str(team)]) == 0
    capsys.readouterr()
    for wrong, message in (
        (["timer", str(team), "--name", "watchdog"], "already exists"),
        (["tmier", str(team)], "did you mean 'timer'?"),
        (["timer/README.md.jinja", str(team)], "the template 'timer' has no file"),
        (["timer"], "templates copy NAME DIR"),
    ):
        assert main(["templates", "copy", *wrong]) == 2
        assert message in capsys.readouterr().err
