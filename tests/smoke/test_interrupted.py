"""An interrupted run reports what was observed so far."""

from __future__ import annotations

import json
import os
import signal
import subprocess
from io import StringIO
from pathlib import Path

import jsonschema
import pytest

from scaffold.smoke import reports
from scaffold.smoke.reports import github, html
from scaffold.smoke.reports.schema import schema
from scaffold.smoke.result import Build, Executable, Observation, PackageResult, Smoke, Topic
from tests import PATIENCE
from tests.smoke.smoke_packages import python_package, talker
from tests.smoke.smoke_runs import NEEDS_ROS, command_line, processes_of, variables, wait_until

SEEN = Observation(nodes=("/talker",), topics=(Topic("/chatter", "std_msgs/msg/String", 1),))
EARLY = Smoke(
    {"kind": "wheels", "distribution": "jazzy", "prefix": "/ros", "rmw": "rmw"},
    (
        PackageResult("done", Build(ok=True), (Executable("talker", SEEN, interrupted=True),)),
        PackageResult("waiting", Build(ok=True), ran=False),
        PackageResult("unbuilt", Build(ok=False, interrupted=True), ran=False),
    ),
    ended_early="interrupted by SIGINT",
)


def written(form: str) -> str:
    out = StringIO()
    reports.report(EARLY, form, out)
    return out.getvalue()


def test_text_lists_packages_that_were_not_run() -> None:
    lines = written("text").splitlines()
    assert "  talker: interrupted" in lines
    assert "unbuilt: not built yet" in lines
    assert "ended early: interrupted by SIGINT" in lines
    assert "no executables" not in written("text")
    assert lines[-1].startswith("3 packages, 1 executable: unbuilt not built; talker interrupted")


def test_json_lists_packages_that_were_not_run() -> None:
    data = json.loads(written("json"))
    assert (data["ok"], data["ended_early"]) == (False, "interrupted by SIGINT")
    assert [package["build"]["interrupted"] for package in data["packages"]] == [
        False, False, True,
    ]  # fmt: skip
    jsonschema.validate(data, schema())
    executable = data["packages"][0]["executables"][0]
    assert (executable["ok"], executable["interrupted"]) == (False, True)
    assert executable["topics"][0]["name"] == "/chatter"


def test_junit_counts_packages_that_were_not_run_as_errors() -> None:
    text = written("junit")
    assert 'errors="2"' in text
    assert "interrupted before the build" in text


def test_github_annotates_the_interruption() -> None:
    assert written("github").startswith(
        "::error title=smoke ended early::interrupted by SIGINT\n::stop-commands::"
    )
    assert "| `unbuilt` | | not built yet |" in github.job_summary(EARLY)


def test_html_lists_packages_that_were_not_run() -> None:
    page = html.page(EARLY)
    assert "Ended early: interrupted by SIGINT" in page
    assert "Not built yet" in page
    assert "No executables." not in page


@NEEDS_ROS
@pytest.mark.build
def test_interrupted_run_reports_its_observations(tmp_path: Path) -> None:
    heard = tmp_path / "heard"
    tick = f"if self.count == 15:\n    open({str(heard)!r}, 'a').close()\n"
    package = python_package(tmp_path, "good_py", {"talker": talker("/numbers", tick=tick)})
    tmp, report, page = tmp_path / "tmp", tmp_path / "report.json", tmp_path / "page"
    tmp.mkdir()
    with subprocess.Popen(
        command_line(
            package, "--duration", "100", "--format", "json", "--output-file", report,
            "--report", page,
        ),
        env=variables(tmp, XDG_STATE_HOME=str(tmp_path / "state")),
        stderr=subprocess.PIPE,
        text=True,
    ) as run:  # fmt: skip
        wait_until(heard.exists)
        run.send_signal(signal.SIGINT)
        _, errors = run.communicate(timeout=PATIENCE)

    assert (run.returncode, errors) == (130, "ros2-scaffold: interrupted by SIGINT\n")
    data = json.loads(report.read_text(encoding="utf-8"))
    jsonschema.validate(data, schema())
    (executable,) = data["packages"][0]["executables"]
    assert data["ended_early"] == "interrupted by SIGINT"
    assert executable["interrupted"]
    assert executable["nodes"] == ["/talker"]
    assert executable["topics"][0]["count"] > 0
    assert "Ended early" in (page / "index.html").read_text(encoding="utf-8")
    assert processes_of(tmp) == []
    assert os.listdir(tmp) == []
