"""Misbehaving nodes: each problem is reported, and nothing is left behind."""

from __future__ import annotations

import json
import subprocess
from pathlib import Path

import pytest

from tests.smoke.smoke_packages import IGNORES_SIGINT, python_package, talker
from tests.smoke.smoke_runs import NEEDS_ROS, command_line, executables_of, processes_of, variables

pytestmark = [pytest.mark.nightly, NEEDS_ROS, pytest.mark.timeout(0)]

FORKS = talker(
    "/forks",
    imports="import os\nimport time",
    tick="""\
    if self.count < 5 and os.fork() == 0:
        os.setsid()
        if os.fork() == 0:
            time.sleep(600)
        os._exit(0)
    """,
)
RENAMES = talker(
    "/renames",
    imports="import ctypes\nimport os\nimport time",
    begin="""\
    ctypes.CDLL(None).prctl(15, b'[kworker/0:1]', 0, 0, 0)
    if os.fork() == 0:
        os.setsid()
        os.environ.clear()
        os.execve('/bin/sleep', ['[kworker/0:2]', '600'], {})
    """,
)
SPAMS = talker("/spams", imports="import sys", tick="sys.stdout.write('spam ' * 4_000_000)")
ONCE_ONLY = talker("/exits", imports="import os", tick="os._exit(3)")
DIES_LATER = talker(
    "/dies",
    imports="import time",
    begin="self.begun = time.monotonic()",
    tick="""\
    if time.monotonic() - self.begun > 10:
        raise RuntimeError('ten seconds are over')
    """,
)
FAST = talker("/fast", period="0.0001")
LARGE = talker(
    "/large",
    period="0.5",
    imports="from std_msgs.msg import UInt8MultiArray",
    begin="self.large = self.create_publisher(UInt8MultiArray, '/huge', 1)",
    tick="self.large.publish(UInt8MultiArray(data=bytes(50_000_000)))",
)
NOTHING = talker("/nothing", tick="return")

CRASHES = talker("/crashes", imports="import ctypes", tick="ctypes.string_at(0)")
STOPS = talker(
    "/stops", imports="import os\nimport signal", tick="os.kill(os.getpid(), signal.SIGSTOP)"
)
BINARY = talker(
    "/binary",
    imports="import os\nimport sys",
    tick="os.write(1, bytes(range(256)) + b'\\x1b[2J\\x1b]0;title\\x07' * 10)",
)
LITTERS = talker(
    "/litters",
    imports="import pathlib\nimport tempfile",
    begin="""\
    pathlib.Path(tempfile.mkdtemp(), 'litter').write_bytes(bytes(1_000_000))
    self.left = open(tempfile.mkstemp()[1], 'wb')
    """,
)
CROWDS = talker(
    "/crowds",
    begin="""\
    self.crowd = [self.create_publisher(String, f'/crowd_{n}', 1) for n in range(200)]
    """,
)
ABORTS = talker(
    "/aborts",
    imports="import os\nimport threading",
    tick="if self.count == 3:\n    threading.Thread(target=os.abort).start()",
)
ARGUMENTS = talker("/arguments", imports="import sys", begin="self.port = sys.argv[1]")
DAEMON = talker("/daemon").replace(
    "    try:\n        rclpy.init",
    """\
    import os
    if os.fork():
        os._exit(0)
    os.setsid()
    if os.fork():
        os._exit(0)
    try:
        rclpy.init""",
)
KEEPS = talker(
    "/keeps",
    imports="from multiprocessing import resource_tracker, shared_memory",
    begin="""\
    self.block = shared_memory.SharedMemory(create=True, size=1_000_000)
    resource_tracker.unregister(self.block._name, 'shared_memory')
    """,
)
MOVES = talker("moves").replace(
    "rclpy.init(args=args)", "rclpy.init(args=['--ros-args', '-r', '__ns:=/moved'])"
)
STRAYS = talker("/strays").replace("rclpy.init(args=args)", "rclpy.init(args=args, domain_id=77)")
TWINS = talker("/twins", begin="self.twin = rclpy.create_node('talker')")

NODES = {
    "aborts": ABORTS,
    "arguments": ARGUMENTS,
    "binary": BINARY,
    "crashes": CRASHES,
    "crowds": CROWDS,
    "daemon": DAEMON,
    "dies": DIES_LATER,
    "exits": ONCE_ONLY,
    "fast": FAST,
    "forks": FORKS,
    "ignores": IGNORES_SIGINT,
    "keeps": KEEPS,
    "large": LARGE,
    "litters": LITTERS,
    "moves": MOVES,
    "nothing": NOTHING,
    "renames": RENAMES,
    "spams": SPAMS,
    "stops": STOPS,
    "strays": STRAYS,
    "twins": TWINS,
}


@pytest.fixture(scope="module")
def problems(tmp_path_factory: pytest.TempPathFactory) -> dict[str, str]:
    """Run all nodes, two at a time; return the problems of each."""
    root = tmp_path_factory.mktemp("zoo")
    package = python_package(root / "src", "zoo", NODES)
    (package / "smoke.yaml").write_text("executables: {dies: {duration: 14}}\n")
    result = executables_of(package, root, "--jobs", "2")
    return {item["name"]: "\n".join(item["problems"]) for item in result}


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("aborts", "SIGABRT"),
        ("arguments", "`arguments` of the executable in smoke.yaml"),
        ("crashes", "SIGSEGV"),
        ("daemon", "leaves a process running: "),
        ("dies", "RuntimeError: ten seconds are over"),
        ("exits", "exit code 3"),
        ("fast", "publishes std_msgs/msg/String at 10000 Hz"),
        ("forks", "leaves a process running: "),
        ("ignores", "ignored SIGINT"),
        ("keeps", "leaves shared memory behind: /dev/shm/psm_"),
        ("nothing", "no message on /nothing"),
        ("renames", "leaves a process running: [kworker/0:2]"),
        ("strays", "uses ROS domain 77 instead of ROS_DOMAIN_ID"),
    ],
)
def test_problem_is_reported(problems: dict[str, str], name: str, said: str) -> None:
    assert said in problems[name]


@pytest.mark.parametrize("name", ["moves", "twins"])
def test_unusual_node_has_no_problem(problems: dict[str, str], name: str) -> None:
    assert problems[name] == ""


@pytest.mark.parametrize("name", ["large", "spams"])
def test_much_output_and_large_messages_do_not_block_the_run(
    problems: dict[str, str], name: str
) -> None:
    """A rate may be missed, and the report says so; nothing hangs, crashes or stays."""
    for word in ("observer", "hangs", "crashed", "ignored", "leaves"):
        assert word not in problems[name]


def test_full_disk(tmp_path: Path) -> None:
    """Observations made before the disk was full are reported, with the reason in one line."""
    package = python_package(tmp_path / "src", "zoo", {"spams": SPAMS})
    disk = tmp_path / "disk"
    disk.mkdir()
    script = (
        f"mount -t tmpfs -o size=8m tmpfs {disk} && "
        f"exec {' '.join(command_line(package, '--duration', '4', '--format', 'json'))}"
    )
    done = subprocess.run(
        ["unshare", "-m", "sh", "-c", script],
        env=variables(disk, XDG_STATE_HOME=str(tmp_path / "state")),
        capture_output=True,
        text=True,
        check=False,
    )
    if "unshare" in done.stderr or "mount" in done.stderr:
        pytest.skip("no right to mount a small disk")
    assert done.returncode in {1, 2}, done.stderr
    assert "internal error" not in done.stderr
    assert json.loads(done.stdout)["packages"][0]["name"] == "zoo"
    assert processes_of(disk) == []
