"""The GitHub action and the GitLab template: valid, and their steps run as written."""

from __future__ import annotations

import json
import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import jsonschema
import pytest

from scaffold.cli.main import main
from scaffold.generate import yaml_file
from scaffold.reporters import NAMES
from tests import PATIENCE
from tests.generate.test_pre_commit import (
    FINDING,
    PERSON,
    clone,
    installing,
    needs_index,
    remove_dependency,
)
from tests.reporters.sarif_schema import SCHEMA as SARIF
from tests.reporters.test_gitlab import SCHEMA as CODE_QUALITY

__all__ = ["clone"]  # a fixture
ROOT = Path(__file__).resolve().parents[1]


@pytest.mark.parametrize(
    ("schema", "name"),
    [("vendor.github-actions", "action.yml"), ("vendor.gitlab-ci", "ci/gitlab.yml")],
)
def test_file_matches_its_schema(schema: str, name: str) -> None:
    command = [sys.executable, "-m", "check_jsonschema", "--builtin-schema", schema, name]
    done = subprocess.run(
        command, capture_output=True, text=True, check=False, timeout=PATIENCE, cwd=ROOT
    )
    assert done.returncode == 0, done.stdout


@pytest.fixture
def checkout(tmp_path: Path) -> Path:
    """Return a repository with a broken package whose path has a space."""
    top = tmp_path / "checkout"
    place = top / "my packages"
    assert main(["new", "talker", *PERSON, "--destination-directory", str(place)]) == 0
    remove_dependency(place / "talker")
    subprocess.run(["git", "init", "-q", str(top)], check=True)
    return top


def run(shell: list[str], script: str, top: Path, variables: dict[str, str]) -> tuple[int, str]:
    """Run a script in a clean environment."""
    done = subprocess.run(
        [*shell, "-c", script],
        cwd=top,
        env={"PATH": "/usr/local/bin:/usr/bin:/bin", "HOME": str(top.parent), **variables},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        check=False,
        timeout=PATIENCE,
    )
    return done.returncode, done.stdout


class Action:
    """The action, run step by step as a runner does."""

    def __init__(self, source: Path, top: Path) -> None:
        self._action: dict[str, Any] = yaml_file.read(str(ROOT / "action.yml"))
        self._top = top
        self._known = {"github.action_path": str(source), "runner.temp": str(top.parent / "temp")}
        self.summary = top.parent / "summary.md"
        (top.parent / "temp").mkdir()

    def step(self, number: int, **inputs: str) -> tuple[int, str]:
        """Run a step with inputs; return its exit code and its log."""
        step = self._action["runs"]["steps"][number]
        assert step["shell"] == "bash"
        assert "${{" not in step["run"]
        given = {name: item["default"] for name, item in self._action["inputs"].items()} | inputs
        known = self._known | {f"inputs.{name}": value for name, value in given.items()}
        variables = {
            name: re.sub(r"\$\{\{ (.+?) \}\}", lambda match: known[match[1]], text)
            for name, text in step["env"].items()
        }
        variables |= {**installing(), "GITHUB_STEP_SUMMARY": str(self.summary)}
        shell = ["bash", "--noprofile", "--norc", "-eo", "pipefail"]
        return run(shell, step["run"], self._top, variables)


def test_action_installs_the_tool_and_checks(clone: Path, checkout: Path, tmp_path: Path) -> None:
    needs_index(tmp_path)
    action = Action(clone, checkout)
    code, log = action.step(0)
    assert code == 0, log
    code, log = action.step(1, paths="my packages/talker\n")
    assert code == 1
    assert log.startswith("::error file=my packages/talker/")
    assert FINDING in log
    assert FINDING in action.summary.read_text().replace("\\", "")

    code, log = action.step(1, format="sarif", args="--output-file=a b.sarif\n--exit-zero")
    assert code == 0, log
    report = json.loads((checkout / "a b.sarif").read_text())
    jsonschema.validate(report, SARIF)
    (uri,) = {
        item["locations"][0]["physicalLocation"]["artifactLocation"]["uri"]
        for item in report["runs"][0]["results"]
        if item["level"] == "error"
    }
    assert uri.startswith("my%20packages/talker/")

    code, log = action.step(1, paths="$(touch injected)")
    assert code == 2
    assert not (checkout / "injected").exists()


def test_gitlab_template_checks_and_stores_its_report(
    clone: Path, checkout: Path, tmp_path: Path
) -> None:
    needs_index(tmp_path)
    (job,) = yaml_file.read(str(ROOT / "ci" / "gitlab.yml")).values()
    before, script = "\n".join(job["before_script"]), "\n".join(job["script"])
    given = {**job["variables"], **installing()}
    code, log = run(["sh", "-e"], before, checkout, given)
    assert code == 2
    assert "set the variable ROS2_SCAFFOLD" in log
    variables = {
        **given,
        "ROS2_SCAFFOLD": str(clone),
        "ROS2_SCAFFOLD_ARGS": "--ignore D --ignore Q",
    }
    code, log = run(["sh", "-e"], f"{before}\n{script}", checkout, variables)
    assert code == 1, log
    assert "1 error" in log
    report = json.loads((checkout / job["artifacts"]["reports"]["codequality"]).read_text())
    jsonschema.validate(report, CODE_QUALITY)
    (path,) = {item["location"]["path"] for item in report}
    assert (checkout / path).is_file()


def test_page_lists_every_report_format() -> None:
    text = (ROOT / "docs" / "integrations.md").read_text()
    for name in NAMES:
        assert f"| `{name}` |" in text


def test_page_lists_action_inputs_and_hooks() -> None:
    text = (ROOT / "docs" / "integrations.md").read_text()
    for name in yaml_file.read(str(ROOT / "action.yml"))["inputs"]:
        assert f"| `{name}` |" in text
    for hook in yaml_file.read(str(ROOT / ".pre-commit-hooks.yaml")):
        assert f"`{hook['id']}`" in text
    (job,) = yaml_file.read(str(ROOT / "ci" / "gitlab.yml")).values()
    for name in job["variables"]:
        assert f"`{name}`" in text
