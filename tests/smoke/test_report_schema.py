"""The JSON schema of the report agrees with the report, and with its page."""

from __future__ import annotations

from copy import deepcopy
from pathlib import Path
from typing import Any

import jsonschema
import pytest

from scaffold.smoke.reports.json import as_data
from scaffold.smoke.reports.schema import schema
from scaffold.smoke.result import (
    Build,
    Endpoint,
    Executable,
    Log,
    LogLine,
    Observation,
    PackageResult,
    Smoke,
    Spread,
    Stop,
    TestCase,
    Tests,
    Topic,
    Transition,
    Usage,
)
from scripts import document_smoke_report

SPREAD = Spread(2, 0.1, 0.0, 0.1, 0.1)
QOS = {
    "reliability": "reliable", "durability": "volatile", "history": "keep_last", "depth": 10,
    "deadline": None, "lifespan": 0.5, "liveliness": "automatic",
    "liveliness_lease_duration": None,
}  # fmt: skip
SEEN = Observation(
    nodes=("/talker",),
    topics=(
        Topic(
            "/chatter", "std_msgs/msg/String", 1, count=3, rate_hz=10.0, interval=SPREAD,
            size=SPREAD, messages=({"data": "hello"},), rates=((0.1, 10.0),),
            endpoints=(Endpoint("publisher", "/talker", "std_msgs/msg/String", QOS),),
        ),
    ),
    services=(("/switch", "std_srvs/srv/SetBool"),),
    parameters={"/talker": {"rate": 2.0}, "/mute": None},
    transitions=(Transition("/talker", "configure", "unconfigured", "inactive", 0.1),),
    log=Log({"info": 1}, (LogLine("info", "talker", "hello", 1.0),)),
    usage=Usage(0.1, None, 1, 2),
)  # fmt: skip
EXECUTABLE = Executable("talker", SEEN, (Stop("SIGINT", 0, 0.1), Stop("SIGTERM", 0, 0.1)))
REPORT = Smoke(
    {"kind": "wheels", "distribution": "jazzy", "prefix": "/ros", "rmw": "rmw"},
    (
        PackageResult(
            "talker",
            Build(ok=True),
            (EXECUTABLE, Executable("once")),
            tests=Tests((TestCase("test_style", "failed", ("E501",)),)),
            together=EXECUTABLE,
            worker="host (tcp://10.0.0.1:1)",
        ),
    ),
)


def test_full_report_is_valid() -> None:
    jsonschema.Draft7Validator.check_schema(schema())
    jsonschema.validate(_as_from_json(as_data(REPORT)), schema())


@pytest.mark.parametrize(
    ("path", "value"),
    [
        (("ok",), "yes"),
        (("ended_early",), 130),
        (("packages", 0, "executables", 0, "topics", 0, "interval", "mean"), None),
        (("packages", 0, "executables", 0, "transitions", 0, "name"), "explode"),
        (("packages", 0, "tests", "cases", 0, "outcome"), "flaky"),
    ],
)
def test_report_with_wrong_value_is_invalid(path: tuple[Any, ...], value: object) -> None:
    data = deepcopy(_as_from_json(as_data(REPORT)))
    holder = data
    for step in path[:-1]:
        holder = holder[step]
    holder[path[-1]] = value
    with pytest.raises(jsonschema.ValidationError):
        jsonschema.validate(data, schema())


def test_documented_schema_is_up_to_date(tmp_path: Path) -> None:
    document_smoke_report.main(tmp_path)
    name = "smoke-report.schema.json"
    assert (tmp_path / name).read_text() == (document_smoke_report.DOCS / name).read_text()


def _as_from_json(value: Any) -> Any:  # noqa: ANN401  JSON
    """Return data as JSON would give it back, with lists for tuples."""
    if isinstance(value, dict):
        return {key: _as_from_json(item) for key, item in value.items()}
    return [*map(_as_from_json, value)] if isinstance(value, (list, tuple)) else value
