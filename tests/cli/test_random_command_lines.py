"""Random command lines never cause a traceback or an internal error."""

from __future__ import annotations

import argparse
import io
import os
from collections.abc import Iterator
from contextlib import redirect_stderr, redirect_stdout
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from scaffold.cli.exit_codes import CLEAN, FINDINGS, USAGE_ERROR
from scaffold.cli.main import main
from scaffold.cli.parser import build_parser
from scaffold.cli.verbs import VERBS

EXAMPLES = int(os.environ.get("SCAFFOLD_COMMAND_LINES", "60"))
LEFT_OUT = {"--build", "--reference"}
"""Flags that start programs for minutes."""
WORDS = (
    *("talker", "talker/package.xml", "talker/talker", "made", ".", "answers.yaml", "nowhere", ""),
    *("PX", "px020", "import-undeclared", "ALL", "E501", "XX", "timer", "publisher", "launch"),
    *("timer:beat", "timer:beat rate=0", "publisher:p topic=x y", "ament_python", "json", "text"),
    *("Apache-2.0", "LaserScan", "std_msgs/msg/String", "rclpyy", "0", "-1", "1e999", "-", "--"),
    *("list", "test", "bash", "clean", "=", "a=b", "[", "{{ x }}", "%s", "\udcff", "\x1b[31m"),
)
TEXT = st.text(st.characters(exclude_characters="/\\~."), max_size=12)
"""Nothing that leads out of the directory."""


def flags() -> list[str]:
    """Return the flags of all verbs, taken from the parser."""
    (verbs,) = [item for item in build_parser()._actions if item.dest == "verb"]  # noqa: SLF001
    assert isinstance(verbs, argparse._SubParsersAction)  # noqa: SLF001
    result: set[str] = set()
    for parser in verbs.choices.values():
        result |= {*parser._option_string_actions}  # noqa: SLF001
    return sorted(result - LEFT_OUT)


@pytest.fixture(scope="module")
def workspace(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Path]:
    top = tmp_path_factory.mktemp("workspace")
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(top)
        patch.setenv("HOME", str(top))
        assert main(["new", "talker", "--maintainer-name", "Ada"]) == 0
        (top / "answers.yaml").write_text("topic: chatter\n")
        yield top


@settings(
    max_examples=EXAMPLES,
    suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow],
)
@given(data=st.data())
def test_random_command_lines(data: st.DataObject, workspace: Path) -> None:
    del workspace
    verb = data.draw(st.sampled_from(sorted({*VERBS} - {"smoke"})))  # it builds for minutes
    word = st.one_of(st.sampled_from(WORDS), st.sampled_from(ALL_FLAGS), TEXT)
    assigned = st.builds("{}={}".format, st.sampled_from(ALL_FLAGS), st.sampled_from(WORDS))
    words = data.draw(st.lists(st.one_of(word, assigned), max_size=5))
    arguments = data.draw(st.permutations([verb, *words])) if data.draw(st.booleans()) else None
    output, errors = io.StringIO(), io.StringIO()
    code: int | str | None
    with redirect_stdout(output), redirect_stderr(errors):
        try:
            code = main(arguments or [verb, *words])
        except SystemExit as end:
            code = end.code
    assert code in {CLEAN, FINDINGS, USAGE_ERROR}, errors.getvalue()
    assert "Traceback" not in errors.getvalue()
    if code == USAGE_ERROR:
        assert "ros2-scaffold: error: " in errors.getvalue()


ALL_FLAGS = flags()
