"""Starts generated publishers, each in its own process, and receives in another one."""

from __future__ import annotations

import json
import subprocess
import sys
import threading
import time
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from textwrap import dedent
from typing import IO, NamedTuple

from scaffold.generate.payload import Payload
from tests import PATIENCE

MESSAGES = 3
"""That are received of each publisher."""

OBSERVER = dedent("""\
    import json
    import os
    import sys

    import pytest
    import rclpy

    # The middleware complains on the first descriptor, which is for what is received alone.
    reports = os.fdopen(os.dup(1), 'w')
    os.dup2(2, 1)
    wanted = json.loads(sys.stdin.readline())
    rclpy.init()
    node = rclpy.create_node('observer')
    received = {}


    def listen(one):
        names = {'pytest': pytest}
        exec(one['import'], names)
        kind = names[one['name']]
        messages = received[one['topic']] = []

        def callback(message):
            messages.append(message)
            if len(messages) == one['messages']:
                report(one, kind, messages, names)

        node.create_subscription(kind, one['topic'], callback, 10)


    def report(one, kind, messages, names):
        failed = [
            check
            for check in one['checks']
            if not all(eval(check, {**names, 'message': message}) for message in messages)
        ]
        print(json.dumps({
            'topic': one['topic'],
            'differs': any(message != kind() for message in messages),
            'changes': len({str(message) for message in messages}) > 1,
            'failed': failed,
        }), file=reports, flush=True)


    for one in wanted:
        listen(one)
    print('ready', file=reports, flush=True)
    rclpy.spin(node)
""")


class Publisher(NamedTuple):
    """A generated node and the message type that it publishes."""

    payload: Payload
    script: Path
    topic: str


class Received(NamedTuple):
    """The messages received from a publisher."""

    publisher: Publisher
    output: str
    """What the node printed."""
    is_received: bool = False
    differs: bool = False
    """Whether a message differs from one whose fields keep their defaults."""
    changes: bool = False
    """Whether one message differs from another."""
    failed: tuple[str, ...] = ()
    """Checks of the payload that are not true of all messages."""

    @property
    def is_good(self) -> bool:
        """Whether type, number and content of the messages are as expected."""
        is_changing = self.publisher.payload.is_changing
        return (
            self.is_received
            and (self.differs, self.changes) == (is_changing, is_changing)
            and not self.failed
        )


def receive(
    publishers: Sequence[Publisher], variables: Mapping[str, str], scratch: Path, *, jobs: int
) -> Iterator[Received]:
    """Yield the result of each publisher as soon as it is complete.

    Args:
        publishers: Nodes to start.
        variables: An environment to run nodes in.
        scratch: A directory for their output.
        jobs: How many of them run at the same time.
    """
    with subprocess.Popen(
        [sys.executable, "-c", OBSERVER],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        env=dict(variables),
        text=True,
    ) as observer:
        try:
            assert observer.stdin is not None
            assert observer.stdout is not None
            observer.stdin.write(json.dumps([_wanted(item) for item in publishers]) + "\n")
            observer.stdin.flush()
            yield from _run(publishers, variables, scratch, observer.stdout, jobs)
        finally:
            observer.kill()


def _wanted(publisher: Publisher) -> dict[str, object]:
    payload = publisher.payload
    return {
        "topic": publisher.topic,
        "import": "\n".join([payload.import_line, *payload.check_imports]),
        "name": payload.name,
        "checks": payload.checks,
        "messages": MESSAGES,
    }


def _run(
    publishers: Sequence[Publisher],
    variables: Mapping[str, str],
    scratch: Path,
    said: IO[str],
    jobs: int,
) -> Iterator[Received]:
    reports: dict[str, dict[str, object]] = {}
    news = threading.Condition()
    assert said.readline() == "ready\n"

    def listen() -> None:
        for line in said:
            report = json.loads(line)
            with news:
                reports[report["topic"]] = report
                news.notify()

    threading.Thread(target=listen, daemon=True).start()
    waiting = list(reversed(publishers))
    running: dict[str, tuple[Publisher, subprocess.Popen[bytes], float]] = {}
    try:
        while waiting or running:
            while waiting and len(running) < jobs:
                item = waiting.pop()
                deadline = time.monotonic() + PATIENCE
                running[item.topic] = (item, _start(item, variables, scratch), deadline)
            with news:
                news.wait_for(lambda: any(topic in reports for topic in running), timeout=1.0)
            for topic, (item, process, deadline) in list(running.items()):
                if topic in reports or process.poll() is not None or time.monotonic() > deadline:
                    process.kill()
                    process.wait()
                    del running[topic]
                    yield _received(item, reports.get(topic), _output(item, scratch))
    finally:
        for _, process, _ in running.values():
            process.kill()
            process.wait()


def _start(
    publisher: Publisher, variables: Mapping[str, str], scratch: Path
) -> subprocess.Popen[bytes]:
    remapped = f"{publisher.payload.topic}:={publisher.topic}"
    arguments = ["-p", "rate:=20.0", "-r", remapped]
    with _output_path(publisher, scratch).open("w") as output:
        return subprocess.Popen(
            [sys.executable, str(publisher.script), "--ros-args", *arguments],
            env=dict(variables),
            stdout=output,
            stderr=subprocess.STDOUT,
        )


def _output_path(publisher: Publisher, scratch: Path) -> Path:
    return scratch / f"{publisher.topic.strip('/')}.txt"


def _output(publisher: Publisher, scratch: Path) -> str:
    return _output_path(publisher, scratch).read_text()


def _received(publisher: Publisher, report: Mapping[str, object] | None, output: str) -> Received:
    if report is None:
        return Received(publisher, output)
    failed = report["failed"]
    assert isinstance(failed, list)
    return Received(
        publisher,
        output,
        is_received=True,
        differs=bool(report["differs"]),
        changes=bool(report["changes"]),
        failed=tuple(failed),
    )
