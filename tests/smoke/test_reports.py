"""Reports of smoke runs: JUnit, GitHub and HTML."""

from __future__ import annotations

import re
import shutil
import subprocess
from dataclasses import replace
from io import StringIO
from itertools import pairwise
from pathlib import Path

import pytest
from lxml import html as lxml_html

from scaffold.cli.main import main
from scaffold.smoke.reports import github, graph, html, plot, report
from scaffold.smoke.result import (
    Build,
    Endpoint,
    Executable,
    Log,
    LogLine,
    Observation,
    PackageResult,
    Problem,
    Smoke,
    Spread,
    Stop,
    Topic,
    Usage,
)
from tests.reporters.test_junit import read, test_result

HOSTILE = (
    "<script>alert(1)</script>\"'&--> <img src=x onerror=alert(2)> </pre></svg></style> \x1b[31m"
)
ENVIRONMENT = {"kind": "wheels", "prefix": "/opt", "rmw": "rmw_fastrtps_cpp"}
SPREAD = Spread(3, 0.1, 0.001, 0.09, 0.11)
QOS = {
    "reliability": "reliable", "durability": "volatile", "history": "keep_last", "depth": 10,
    "deadline": None, "lifespan": 1.5, "liveliness": "automatic",
}  # fmt: skip


def topic(name: str, *, by: str = "/talker", to: str | None = None) -> Topic:
    endpoints = [Endpoint("publisher", by, "std_msgs/msg/String", QOS)]
    if to is not None:
        endpoints.append(Endpoint("subscription", to, "std_msgs/msg/String", QOS))
    return Topic(
        name, "std_msgs/msg/String", 1, count=4, rate_hz=10.0, messages=({"data": name},),
        endpoints=tuple(endpoints), first_after=0.5, lost=0, interval=SPREAD, size=SPREAD,
        rates=((0.1, 10.0), (0.2, 12.0), (0.3, 8.0)),
    )  # fmt: skip


def executable(name: str, *problems: Problem, text: str = "text") -> Executable:
    return Executable(
        name,
        Observation(
            nodes=(f"/{text}",),
            topics=(topic(f"/{text}", by=f"/{text}"),),
            services=((f"/service{text}", "std_srvs/srv/Empty"),),
            parameters={f"/{text}": {text: [text, 1.5]}},
            log=Log({"error": 1}, (LogLine("error", text, text, 1.0),)),
            usage=Usage(1.0, 5.0, 1000, 2000),
        ),
        stops=(Stop("SIGINT", 0, 0.1),),
        problems=problems,
        notes=(f"note {text}",),
        source="src/demo/demo/talker.py",
        seconds=2.5,
    )


PROBLEM = Problem("crashed at start: 100 %", ("::error::forged", "line: 2"))


def smoke_of(*executables: Executable, build: Build = Build(ok=True, seconds=1.5)) -> Smoke:  # noqa: B008  frozen
    package = PackageResult("demo", build, executables, "src/demo/package.xml")
    return Smoke(ENVIRONMENT, (package,))


def written(result: Smoke, form: str) -> str:
    out = StringIO()
    report(result, form, out)
    return out.getvalue()


# -- JUnit


def test_junit_has_a_case_for_the_build_and_each_executable(tmp_path: Path) -> None:
    result = smoke_of(executable("talker"), executable("crasher", PROBLEM))
    (tmp_path / "smoke.xunit.xml").write_text(written(result, "junit"))
    code, output = test_result(tmp_path, "--verbose")
    assert code == 1
    assert "3 tests, 0 errors, 1 failure, 0 skipped" in output
    assert "crashed at start: 100 %" in output


def test_junit_of_a_failed_build(tmp_path: Path) -> None:
    result = smoke_of(build=Build(ok=False, errors=("CMake Error",)))
    (tmp_path / "smoke.xunit.xml").write_text(written(result, "junit"))
    code, output = test_result(tmp_path, "--verbose")
    assert (code, "1 test, 0 errors, 1 failure, 0 skipped" in output) == (1, True)
    assert "CMake Error" in output


def test_junit_has_times_files_and_observations() -> None:
    root = read(written(smoke_of(executable("talker", text=HOSTILE)), "junit"))
    build, talker = root.iter("testcase")
    assert (build.get("name"), build.get("time")) == ("smoke build", "1.500")
    assert build.get("file") == "src/demo/package.xml"
    assert (talker.get("classname"), talker.get("name")) == ("demo.ros2_scaffold", "smoke talker")
    assert (talker.get("file"), talker.get("time")) == (executable("talker").source, "2.500")
    assert "note <script>alert(1)</script>" in (talker.findtext("system-out") or "")


# -- GitHub


def test_problems_are_annotations_at_their_source() -> None:
    text = written(smoke_of(executable("crasher", PROBLEM)), "github")
    assert text.splitlines()[0] == (
        "::error file=src/demo/demo/talker.py,title=demo crasher"
        "::crashed at start: 100 %25%0A::error::forged%0Aline: 2"
    )


def test_output_of_executables_cannot_inject_workflow_commands() -> None:
    lines = written(smoke_of(executable("crasher", PROBLEM)), "github").splitlines()
    token = lines[1].removeprefix("::stop-commands::")
    assert re.fullmatch("[0-9a-f]{64}", token)
    forged = [number for number, line in enumerate(lines) if line.strip() == "::error::forged"]
    assert all(1 < number < lines.index(f"::{token}::") for number in forged)
    assert len(forged) == 1


def test_job_summary_is_a_table_with_escaped_text() -> None:
    hostile = executable(HOSTILE, Problem(f"| {HOSTILE}"), text=HOSTILE)
    summary = github.job_summary(smoke_of(executable("talker"), hostile))
    assert "| `demo` | `talker` | ok | `/text` 4 messages, 10.00 Hz |" in summary
    assert "<script>" not in re.sub("`[^`]*`", "", summary)
    assert len({line.count(" | ") for line in summary.splitlines() if line.startswith("| `")}) == 1


# -- the page


def parsed_page(result: Smoke) -> lxml_html.HtmlElement:
    return lxml_html.document_fromstring(html.page(result))


def test_page_has_plot_graph_tables_and_texts() -> None:
    page = parsed_page(smoke_of(executable("talker"), executable("crasher", PROBLEM)))
    assert [item.text_content() for item in page.xpath("//h1")] == ["Smoke test: not ok"]
    assert [item.text_content() for item in page.xpath("//h3")] == ["talker: ok", "crasher: not ok"]
    assert len(page.xpath("//polyline")) == 2
    assert len(page.xpath("//path[@class='arrow']")) == 2
    text = page.text_content()
    for expected in (
        "keep last 10",
        "crashed at start: 100 %",
        '{data: "/text"}',
        "Built in 1.5 s",
    ):
        assert expected in text


def test_page_is_accessible_and_needs_no_network() -> None:
    page = parsed_page(smoke_of(executable("talker")))
    assert page.xpath("/html/@lang") == ["en"]
    assert page.xpath("//meta[@name='viewport']")
    assert all(item.get("scope") for item in page.xpath("//th"))
    assert all(item.xpath("caption") for item in page.xpath("//table"))
    pictures = page.xpath("//svg[@role='img']")
    assert len(pictures) == 2
    assert all(item.xpath("title") and item.xpath("desc") for item in pictures)
    levels = [int(item.tag[1]) for item in page.xpath("//h1|//h2|//h3|//h4")]
    assert levels[0] == 1
    assert all(after <= before + 1 for before, after in pairwise(levels))
    addresses = page.xpath("//@src|//@href")
    assert all(address.startswith(("#", "data:")) for address in addresses)
    assert "prefers-color-scheme: dark" in html.page(smoke_of())


def test_foreign_text_is_escaped_in_html() -> None:
    hostile = executable(HOSTILE, Problem(HOSTILE, (HOSTILE,)), text=HOSTILE)
    build = Build(ok=True, warnings=(HOSTILE,))
    result = smoke_of(hostile, build=build)
    result = replace(result, notes=(HOSTILE,), environment={**ENVIRONMENT, "prefix": HOSTILE})
    page = parsed_page(result)
    assert page.xpath("//script|//img|//@onerror") == []
    plain = parsed_page(smoke_of(executable("plain", Problem("p", ("o",))), build=Build(ok=True)))
    assert len(page.xpath("//article//*")) == len(plain.xpath("//article//*"))
    assert "\x1b" not in html.page(result)


def browser() -> str | None:
    names = ("chromium", "chromium-browser", "google-chrome", "chrome")
    return next((path for name in names if (path := shutil.which(name))), None)


@pytest.mark.skipif(browser() is None, reason="no headless browser: install chromium")
def test_browser_renders_the_page(tmp_path: Path) -> None:
    path = html.write(smoke_of(executable(HOSTILE, Problem(HOSTILE), text=HOSTILE)), str(tmp_path))
    done = subprocess.run(
        [
            str(browser()), "--headless", "--no-sandbox", "--disable-gpu",
            "--enable-logging=stderr", f"--user-data-dir={tmp_path / 'profile'}",
            "--dump-dom", Path(path).as_uri(),
        ],
        capture_output=True,
        text=True,
        check=True,
    )  # fmt: skip
    shown = lxml_html.document_fromstring(done.stdout)
    assert shown.xpath("//script|//img") == []
    assert shown.xpath("count(//article//polyline)") == 1
    assert "CONSOLE" not in done.stderr


# -- pictures


def test_graph_is_layered_from_left_to_right() -> None:
    seen = Observation(
        nodes=("/camera", "/filter"),
        topics=(topic("/image", by="/camera", to="/filter"), topic("/clean", by="/filter")),
    )
    picture = graph.of_observation(seen)
    assert picture is not None
    places = {box.name: box.x for box in picture.boxes}
    assert sorted(places, key=places.__getitem__) == ["/camera", "/image", "/filter", "/clean"]
    assert picture.sentences == (
        "/camera publishes /image", "/filter subscribes to /image", "/filter publishes /clean",
    )  # fmt: skip


def test_graph_with_a_cycle() -> None:
    seen = Observation(nodes=("/loop",), topics=(topic("/echo", by="/loop", to="/loop"),))
    picture = graph.of_observation(seen)
    assert picture is not None
    assert (len(picture.boxes), len(picture.arrows)) == (2, 2)


def test_graph_size_is_bounded() -> None:
    seen = Observation(
        nodes=("/talker",), topics=tuple(topic(f"/t{number}") for number in range(100))
    )
    picture = graph.of_observation(seen)
    assert picture is not None
    assert (len(picture.boxes), picture.left_out) == (graph.MOST_BOXES, 101 - graph.MOST_BOXES)


def test_empty_graph() -> None:
    assert graph.of_observation(Observation()) is None


@pytest.mark.parametrize("hertz", [1e-7, 0.5, 10.0, 9999.0])
def test_plot_stays_within_its_axes(hertz: float) -> None:
    line = plot.of_topic(replace(topic("/t"), rates=((1.0, hertz), (2.0, hertz / 2))))
    assert line is not None
    for point in line.points.split():
        x, y = map(float, point.split(","))
        assert plot.LEFT <= x <= plot.WIDTH - plot.RIGHT
        assert plot.TOP <= y <= plot.HEIGHT - plot.BOTTOM
    assert 2 <= len(line.rates) <= 6


# -- the command line


@pytest.mark.parametrize(
    ("flag", "message"),
    [
        ("--report", "--report {}: is a file, not a directory"),
        ("--output-file", "--output-file {}/x: there is no directory '{}'; create it"),
    ],
)
def test_output_paths_are_validated_before_the_run(
    flag: str, message: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "file"
    file.touch()
    place = str(file) if flag == "--report" else f"{file}/x"
    assert main(["smoke", str(tmp_path), flag, place]) == 2
    text = message.replace("{}", str(file))
    assert capsys.readouterr().err == f"ros2-scaffold: error: {text}\n"
