"""A cluster whose network fails during a run: connections stay open, but no data arrives."""

from __future__ import annotations

import json
import os
import re
import signal
import socket
import subprocess
import threading
import time
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from scaffold.cluster.silence import PATIENCE as SILENCE
from tests import PATIENCE
from tests.dask_cluster import Running, cluster
from tests.smoke.smoke_packages import python_package, talker
from tests.smoke.smoke_runs import NEEDS_ROS, command_line, processes_of, variables, wait_until

pytest.importorskip("distributed", reason="install the extra 'cluster' of this project")
pytestmark = [pytest.mark.nightly, NEEDS_ROS, pytest.mark.timeout(0)]

PACKAGES = 5
TTL = f"{SILENCE + 20:g}s"
"""After which the scheduler gives up a worker: Dask's own default is five minutes."""


class Proxy:
    """Forwards connections to a port of the loopback network, until they are cut.

    Args:
        port: The port of the real server.
    """

    def __init__(self, port: int) -> None:
        self._target = ("127.0.0.1", port)
        self._server = socket.create_server(("127.0.0.1", 0))
        self.port = self._server.getsockname()[1]
        self._flows = threading.Event()
        self._flows.set()
        self._open: list[socket.socket] = []
        threading.Thread(target=self._accept, daemon=True).start()

    def cut(self) -> None:
        """Keep all connections open, but forward nothing."""
        self._flows.clear()

    def restore(self) -> None:
        """Forward the data received in the meantime, and all further data."""
        self._flows.set()

    def close(self) -> None:
        self._server.close()
        for item in self._open:
            item.close()

    def _accept(self) -> None:
        while True:
            try:
                near, _ = self._server.accept()
                far = socket.create_connection(self._target)
            except OSError:
                return
            self._open += [near, far]
            for pair in ((near, far), (far, near)):
                threading.Thread(target=self._forward, args=pair, daemon=True).start()

    def _forward(self, source: socket.socket, target: socket.socket) -> None:
        try:
            while data := source.recv(2**16):
                self._flows.wait()
                target.sendall(data)
            target.shutdown(socket.SHUT_WR)
        except OSError:
            return


@contextmanager
def run_of(tmp_path: Path, address: str) -> Iterator[subprocess.Popen[str]]:
    """Run some packages on a cluster."""
    for number in range(PACKAGES):
        name = f"cut_{number}"
        python_package(tmp_path / "src", name, {"talker": talker(f"/{name}")})
    (tmp_path / "tmp").mkdir()
    flags = ["--cluster", address, "--duration", "1", "--format", "json"]
    with subprocess.Popen(
        command_line(tmp_path / "src", *flags),
        env=variables(tmp_path / "tmp"),
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    ) as run:
        yield run


def is_busy(running: Running, number: int) -> Callable[[], bool]:
    return lambda: "talker" in " ".join(processes_of(running.workers[number].tmp))


def port_of(address: str) -> int:
    return int(address.rpartition(":")[2])


def test_packages_of_silent_worker_run_elsewhere(tmp_path: Path) -> None:
    slow = {"DASK_DISTRIBUTED__SCHEDULER__WORKER_TTL": TTL}
    with (
        cluster(tmp_path, 2, of_all=slow) as running,
        run_of(tmp_path, running.address) as run,
    ):
        victim = running.workers[1]
        wait_until(is_busy(running, 1))
        victim.process.send_signal(signal.SIGSTOP)
        out, errors = run.communicate(timeout=PATIENCE)
    assert run.returncode == 0, errors
    packages = json.loads(out)["packages"]
    assert Counter(item["name"] for item in packages) == Counter(
        f"cut_{number}" for number in range(PACKAGES)
    )
    address = re.search(r"worker at: +'?(tcp://[\d.:]+)", victim.log.read_text())
    assert address is not None
    assert f"{address[1]} has not been heard for " in errors
    assert errors.count("has not been heard") == 1
    wait_until(lambda: processes_of(victim.tmp) == [])


def test_packages_of_disconnected_worker_run_elsewhere(tmp_path: Path) -> None:
    """The worker itself continues: its results are not counted twice."""
    slow = {"DASK_DISTRIBUTED__SCHEDULER__WORKER_TTL": TTL}
    with cluster(tmp_path, 1, of_all=slow) as running:
        proxy = Proxy(port_of(running.address))
        far = f"tcp://127.0.0.1:{proxy.port}"
        with running.worker(far, slow) as worker:
            wait_until(lambda: "Registered to" in worker.log.read_text())
            with run_of(tmp_path, running.address) as run:
                wait_until(is_busy(running, 1))
                proxy.cut()
                out, errors = run.communicate(timeout=PATIENCE)
        proxy.close()
    assert run.returncode == 0, errors
    names = Counter(item["name"] for item in json.loads(out)["packages"])
    assert names == Counter(f"cut_{number}" for number in range(PACKAGES))
    assert "has not been heard for " in errors


def test_reconnected_worker_delivers_its_results(tmp_path: Path) -> None:
    """It is reported while silent, and no result is lost or counted twice."""
    with cluster(tmp_path, 1) as running:
        proxy = Proxy(port_of(running.address))
        with running.worker(f"tcp://127.0.0.1:{proxy.port}", {}) as worker:
            wait_until(lambda: "Registered to" in worker.log.read_text())
            with run_of(tmp_path, running.address) as run:
                wait_until(is_busy(running, 1))
                proxy.cut()
                time.sleep(SILENCE + 10)
                proxy.restore()
                out, errors = run.communicate(timeout=PATIENCE)
        proxy.close()
    assert run.returncode == 0, errors
    packages = json.loads(out)["packages"]
    names = Counter(item["name"] for item in packages)
    assert names == Counter(f"cut_{number}" for number in range(PACKAGES))
    assert len({item["worker"] for item in packages}) == 2
    assert errors.count("has not been heard for ") == 1


def test_silent_scheduler_ends_the_run(tmp_path: Path) -> None:
    with cluster(tmp_path, 1) as running:
        proxy = Proxy(port_of(running.address))
        with run_of(tmp_path, f"tcp://127.0.0.1:{proxy.port}") as run:
            wait_until(is_busy(running, 0))
            proxy.cut()
            out, errors = run.communicate(timeout=PATIENCE)
        proxy.close()
    assert run.returncode == 1, errors
    assert "Traceback" not in errors
    packages = json.loads(out)["packages"]
    assert len(packages) == PACKAGES
    for package in packages:
        if not package["build"]["ok"]:
            (error,) = package["build"]["errors"]
            assert error == f"the scheduler has not responded for {SILENCE:g} s"
    assert not all(package["build"]["ok"] for package in packages)
    assert os.listdir(tmp_path / "tmp") == []
