"""Unusual nodes: smoke observes them correctly, and nothing is left behind."""

from __future__ import annotations

from typing import Any

import pytest

from tests.smoke.smoke_packages import python_package, talker
from tests.smoke.smoke_runs import NEEDS_ROS, executables_of

pytestmark = [pytest.mark.nightly, NEEDS_ROS, pytest.mark.timeout(0)]

CLOSES_OUTPUT = talker(
    "/closes_output", imports="import os", begin="os.close(0)\nos.close(1)\nos.close(2)"
)
GRANDCHILDREN = talker(
    "/grandchildren",
    imports="import os\nimport signal\nimport time",
    begin="""\
    if os.fork() == 0:
        for number in range(3):
            if os.fork() == 0:
                os.setsid()
                signal.signal(signal.SIGTERM, signal.SIG_IGN)
                time.sleep(600)
                os._exit(0)
        time.sleep(600)
        os._exit(0)
    """,
)
ENDLESS_LINE = talker(
    "/endless_line", imports="import os", tick="os.write(2, b'\\x1b[31m\\xff\\0' * 100_000)"
)
HOMELESS = talker(
    "/homeless",
    imports="import os\nimport shutil",
    begin="""\
    here = os.getcwd()
    os.chdir('/')
    shutil.rmtree(here)
    shutil.rmtree(os.environ['ROS_LOG_DIR'], ignore_errors=True)
    """,
)
THREAD_EXITS = talker(
    "/thread_exits",
    imports="import os\nimport threading",
    tick="if self.count == 5:\n    threading.Thread(target=os._exit, args=(0,)).start()",
)
BLOCKED_IN_C = talker(
    "/blocked_in_c",
    imports="import ctypes\nimport signal",
    begin="""\
    mask = ctypes.create_string_buffer(b'\\xff' * 128)
    self.library, self.mask = ctypes.PyDLL(None), mask
    """,
    tick="""\
    if self.count == 12:
        self.library.pthread_sigmask(0, self.mask, None)
        self.library.sleep(600)
    """,
)
CHANGES_TYPE = talker(
    "/changes_type",
    imports="from std_msgs.msg import Int32",
    tick="""\
    if self.count == 8:
        self.destroy_publisher(self.publisher)
        self.publisher = self.create_publisher(Int32, '/changes_type', 10)
    if self.count >= 8:
        self.publisher.publish(Int32(data=self.count))
        self.count += 1
        return
    """,
)
NEW_NAMES = talker(
    "/new_names",
    tick="""\
    if self.count % 5 == 4 and self.count < 20:
        self.other = rclpy.create_node(f'name_{self.count}')
    """,
)
FLOODS_LOG = talker(
    "/floods_log",
    tick="for number in range(300):\n    self.get_logger().warning(f'warning {number} ' * 20)",
)
EATS_MEMORY = talker(
    "/eats_memory",
    begin="self.eaten = []",
    tick="self.eaten.append(bytearray(b'x' * 10_000_000))",
)
READS_INPUT = talker("/reads_input", begin="self.line = input('which port? ')")
CLOSES_ALL = talker(
    "/closes_all", imports="import os", tick="if self.count == 10:\n    os.closerange(3, 4096)"
)

NODES = {
    "blocked_in_c": BLOCKED_IN_C,
    "changes_type": CHANGES_TYPE,
    "closes_all": CLOSES_ALL,
    "closes_output": CLOSES_OUTPUT,
    "eats_memory": EATS_MEMORY,
    "endless_line": ENDLESS_LINE,
    "floods_log": FLOODS_LOG,
    "grandchildren": GRANDCHILDREN,
    "homeless": HOMELESS,
    "new_names": NEW_NAMES,
    "reads_input": READS_INPUT,
    "thread_exits": THREAD_EXITS,
}


@pytest.fixture(scope="module")
def executables(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Any]:
    """Run all nodes, two at a time; return the report on each."""
    root = tmp_path_factory.mktemp("strange")
    package = python_package(root / "src", "strange", NODES)
    return {item["name"]: item for item in executables_of(package, root, "--jobs", "2")}


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("blocked_in_c", "ignored SIGINT: still running after 5 s, SIGKILL ended it"),
        ("changes_type", "has several types: std_msgs/msg/Int32, std_msgs/msg/String"),
        ("closes_all", "ignored SIGINT"),
        ("grandchildren", "leaves a process running: "),
        ("reads_input", "EOFError: EOF when reading a line"),
    ],
)
def test_problem_is_reported(executables: dict[str, Any], name: str, said: str) -> None:
    assert said in "\n".join(executables[name]["problems"])


@pytest.mark.parametrize(
    "name",
    ["closes_output", "eats_memory", "endless_line", "floods_log", "homeless", "new_names"],
)
def test_strange_node_is_observed(executables: dict[str, Any], name: str) -> None:
    """A rate may be missed on a busy machine, and the report says so."""
    for word in ("observer", "hangs", "crashed", "ignored", "leaves"):
        assert word not in "\n".join(executables[name]["problems"])
    (topic,) = (item for item in executables[name]["topics"] if item["name"] == f"/{name}")
    assert topic["count"] > 0
    assert executables[name]["stop"]["exit_code"] == 0


def test_measurements_of_strange_nodes(executables: dict[str, Any]) -> None:
    assert executables["eats_memory"]["usage"]["memory_peak"] > 150_000_000
    assert executables["floods_log"]["log"]["counts"]["warn"] > 300
    assert len(executables["new_names"]["nodes"]) == 5
    assert len(executables["grandchildren"]["problems"]) == 4
    (note,) = executables["thread_exits"]["notes"]
    assert note.startswith("exited on its own after ")
