"""Generated tests detect mutated nodes.

Each kind of node is generated and installed, then its source is broken in one place at a time: a
field is dropped, a counter stays constant, a parameter is ignored, a callback is not connected. Of
all these mutants the tests that were generated with the node must catch nine tenths.
``SCAFFOLD_NODE_MUTANTS`` limits their number, ``SCAFFOLD_MUTANT_SEED`` says which they are; every
kind gets its share. ``SCAFFOLD_MUTANT_NODES`` names the nodes to break, separated by commas, so
that several processes can share the work. Kinds whose libraries are not installed are left out, and
named.
"""

from __future__ import annotations

import ast
import os
import re
import subprocess
import sys
from collections.abc import Iterator, Mapping
from importlib.util import find_spec
from itertools import zip_longest
from pathlib import Path
from random import Random
from typing import NamedTuple

import pytest

from scaffold.configuration import content
from scaffold.generate import draft
from scaffold.generate.questions.defaults import User
from scaffold.generate.questions.questions import Given
from scaffold.generate.templates import loading
from scaffold.smoke import environment

COUNT = int(os.environ.get("SCAFFOLD_NODE_MUTANTS", "1000"))
SEED = int(os.environ.get("SCAFFOLD_MUTANT_SEED", "1"))
CHOSEN = os.environ.get("SCAFFOLD_MUTANT_NODES", "")
CAUGHT = 0.9
"""The part of the mutants that the tests have to catch."""
ROOTS = content.roots("templates")
TEMPLATES = loading.load(ROOTS)
NODES: Mapping[str, Mapping[str, str]] = {
    "scan": {"node_kind": "publisher", "message_type": "LaserScan"},
    "odometry": {"node_kind": "publisher", "message_type": "Odometry"},
    "battery": {"node_kind": "lifecycle", "message_type": "BatteryState"},
    "map": {"node_kind": "subscriber", "message_type": "OccupancyGrid"},
    "approach": {
        "node_kind": "publisher_subscriber",
        "input_type": "LaserScan",
        "message_type": "Twist",
    },
    "uptime": {"node_kind": "timer"},
    "wheels": {"node_kind": "parameters"},
    "switch": {"node_kind": "service_server", "service_type": "std_srvs/srv/SetBool"},
    "switcher": {"node_kind": "service_client", "service_type": "std_srvs/srv/SetBool"},
    "guard": {"node_kind": "service_relay", "service_type": "std_srvs/srv/SetBool"},
    "numbers": {"node_kind": "action_server", "action_type": "test_msgs/action/Fibonacci"},
    "asker": {"node_kind": "action_client", "action_type": "test_msgs/action/Fibonacci"},
    "pairs": {"node_kind": "synchronizer"},
    "base": {"node_kind": "tf2_broadcaster"},
    "finder": {"node_kind": "tf2_listener"},
    "mount": {"node_kind": "tf2_static_broadcaster"},
    "teleop": {"node_kind": "keyboard_teleop"},
    "manager": {"node_kind": "lifecycle_manager"},
    "duo": {"node_kind": "composed_nodes"},
    "mask": {"node_kind": "image_pipeline"},
    "watcher": {"node_kind": "diagnostics"},
    "device": {"node_kind": "serial_driver"},
    "patrol": {"node_kind": "nav2_client"},
}
LIBRARIES = (
    *("cv_bridge", "diagnostic_updater", "message_filters", "nav2_simple_commander"),
    *("serial", "tf2_msgs", "tf2_ros", "tf2_py"),
)
"""What some kinds need and no wheel has."""
NOTHING_TO_SEE = (
    r"get_logger|^\s*#|\"\"\"|super\(\)\.__init__\('|destroy|try_shutdown|SIGTERM|rclpy\.ok|"
    r"node is not None|\bfrom\b|import|remove_pending|\.close\(\)"
)
"""Lines whose loss nobody sees, such as a leak, or which break everything."""
SUBSTITUTIONS = (
    (r"1\.0 / (self\.)?rate", r"2.0 / \g<1>rate"),
    (r"self\.count \+= 1", "self.count += 0"),
    (r"= self\.frame_id", "= 'wrong'"),
    (r"(create_publisher\(\w+, )'\w+'", r"\1'wrong'"),
    (r"(create_service\(\w+, )'\w+'", r"\1'wrong'"),
    (r"(create_client\(\w+, )'\w+'", r"\1'wrong'"),
    (r", self\.publish_message\)", ", lambda: None)"),
    (r"(self\.receive_message), \d+\)", r"\1, rclpy.qos.qos_profile_sensor_data)"),
    (r"(self\.receive_message), qos_profile_sensor_data\)", r"\1, 10)"),
    (r", self\.receive_message,", ", lambda msg: None,"),
    (r"from_value=0\.1", "from_value=-9.0"),
    (r"except ParameterException", "except KeyError"),
    (r"(\d+\.\d+)(  #.*)?$", r"7.0 * \1\2"),
    (r"min\(", "max("),
    (r"ReentrantCallbackGroup\(\)", "MutuallyExclusiveCallbackGroup()"),
    (r"await future", "future.result()"),
    (r" \+ (?!.*sin\(self\.count)", " - "),
    (r"return SetParametersResult\(successful=False", "return SetParametersResult(successful=True"),
    (r"return GoalResponse\.REJECT", "return GoalResponse.ACCEPT"),
    (r"goal_handle\.succeed\(\)", "goal_handle.abort()"),
    (r"goal_handle\.canceled\(\)", "goal_handle.abort()"),
    (r"1\.0 / (self\.)?rate", "0.5"),
    (r" - ", " + "),
    (r"\bif not ", "if "),
    (r"\bif (?!not |__)", "if not "),
    (r"(\w+)\.y\b", r"\1.x"),
    (r"sin\((?!self\.count)", "cos("),
    (r"slop\)", "0.0)"),
    (r"self\.(first|second), self\.(first|second)", r"self.\2, self.\1"),
    (r"self\.(target|source)_frame, self\.(target|source)_frame", r"self.\2_frame, self.\1_frame"),
    (r"second\.header", "first.header"),
)
"""What is replaced, one place at a time."""

pytestmark = [
    pytest.mark.nightly,
    pytest.mark.timeout(0),
    pytest.mark.skipif(find_spec("rclpy") is None, reason="no ROS 2: install the extra 'ros'"),
]


class Mutant(NamedTuple):
    """A node with one mutated line."""

    node: str
    text: str
    change: str
    """The line and what has become of it."""


def mutants(node: str, text: str) -> Iterator[Mutant]:
    """Yield nodes with one line changed or removed, if they still parse."""
    lines = text.splitlines()
    end = next(at for at, line in enumerate(lines) if line.startswith("def main("))
    start = next(at for at, line in enumerate(lines) if line.startswith("class "))
    for at in range(start, len(lines)):
        line = lines[at]
        changed = {re.sub(old, new, line) for old, new in SUBSTITUTIONS} - {line}
        is_statement = re.fullmatch(
            r" +(?:self|msg|feedback|result|response|goal|request|transform)\b.*", line
        )
        if at < end and is_statement:
            changed.add(f"{line[: len(line) - len(line.lstrip())]}pass")
        for other in sorted(changed if not re.search(NOTHING_TO_SEE, line) else ()):
            broken = "\n".join([*lines[:at], other, *lines[at + 1 :], ""])
            try:
                ast.parse(broken)
            except SyntaxError:
                continue
            yield Mutant(node, broken, f"{line.strip()} -> {other.strip()}")


def install(directory: Path, answers: Mapping[str, str]) -> Path:
    """Write a package, and an install space that points to it; return the module of its node."""
    given = {"package": "pkg", "node_name": "worker", "maintainer_name": "Ada", **answers}
    given["maintainer_email"] = "ada@example.com"
    asked = {name: Given(value, name) for name, value in given.items()}
    made = draft.draft(ROOTS, TEMPLATES, asked, User(str(directory)))
    for path, text in made.rendered.files.items():
        (directory / "src" / path).parent.mkdir(parents=True, exist_ok=True)
        # A mutant that does nothing should not take a minute to be caught.
        (directory / "src" / path).write_text(text.replace("TIMEOUT = 50.0", "TIMEOUT = 25.0"))
    index = directory / "install" / "share" / "ament_index" / "resource_index" / "packages"
    index.mkdir(parents=True)
    (index / "pkg").touch()
    for place, source in (("lib/pkg", "pkg"), ("share/pkg", "")):
        (directory / "install" / place).parent.mkdir(parents=True, exist_ok=True)
        (directory / "install" / place).symlink_to(directory / "src" / source)
    return directory / "src" / "pkg" / "worker.py"


def passes(directory: Path) -> subprocess.CompletedProcess[str]:
    """Run the generated tests of a package."""
    variables = dict(environment.select(os.environ).variables)
    variables["AMENT_PREFIX_PATH"] = os.pathsep.join(
        filter(None, [str(directory / "install"), variables.get("AMENT_PREFIX_PATH")])
    )
    variables["PYTHONDONTWRITEBYTECODE"] = "1"
    return subprocess.run(
        [sys.executable, "-m", "pytest", "-q", "-x", "-p", "no:cacheprovider", "src/test"],
        cwd=directory,
        env=variables,
        capture_output=True,
        text=True,
        check=False,
    )


def missing_libraries(text: str) -> list[str]:
    """Return the libraries that a node needs and that are not installed."""
    imported = set(re.findall(r"^(?:from|import) (\w+)", text, re.MULTILINE))
    return [name for name in LIBRARIES if name in imported and not find_spec(name)]


def sample(sources: Mapping[str, str]) -> list[Mutant]:
    """Return mutants in random order, taken from all nodes in turn."""
    random = Random(SEED)  # noqa: S311  no secret
    queues = [[*mutants(name, text)] for name, text in sources.items()]
    for queue in queues:
        random.shuffle(queue)
    in_turn = [mutant for together in zip_longest(*queues) for mutant in together if mutant]
    return in_turn[:COUNT]


def test_generated_tests_detect_mutants(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    ros = environment.select(os.environ)
    monkeypatch.setenv("AMENT_PREFIX_PATH", ros.variables["AMENT_PREFIX_PATH"])
    names = CHOSEN.split(",") if CHOSEN else [*NODES]
    modules = {name: install(tmp_path / name, NODES[name]) for name in names}
    sources = {name: module.read_text() for name, module in modules.items()}
    for name in [name for name, text in sources.items() if missing_libraries(text)]:
        sys.stdout.write(f"{name} left out: no {', '.join(missing_libraries(sources.pop(name)))}\n")
    chosen = sample(sources)
    for name in sources:
        done = passes(tmp_path / name)
        assert done.returncode == 0, f"{name}: {done.stdout}"
    survived: dict[str, list[str]] = {name: [] for name in sources}
    for mutant in chosen:
        modules[mutant.node].write_text(mutant.text)
        if passes(tmp_path / mutant.node).returncode == 0:
            survived[mutant.node].append(mutant.change)
        modules[mutant.node].write_text(sources[mutant.node])
    for name, changes in survived.items():
        count = sum(mutant.node == name for mutant in chosen)
        sys.stdout.write(f"{name}: {count - len(changes)} of {count} mutants caught\n")
        sys.stdout.write("".join(f"    {change}\n" for change in changes))
    caught = len(chosen) - sum(map(len, survived.values()))
    sys.stdout.write(f"{caught} of {len(chosen)} mutants caught\n")
    assert caught >= CAUGHT * len(chosen), survived
