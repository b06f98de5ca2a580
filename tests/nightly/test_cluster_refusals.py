"""Unusable clusters: one error line with the reason and what to do."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Mapping
from pathlib import Path

import pytest

from scaffold import __version__
from tests import PATIENCE
from tests.dask_cluster import cluster
from tests.smoke.smoke_runs import ROOT, processes_of, variables, wait_until

pytest.importorskip("distributed", reason="install the extra 'cluster' of this project")
pytestmark = [pytest.mark.nightly, pytest.mark.timeout(0)]

PACKAGE = "<package format='3'><name>robot</name><version>0.0.0</version></package>"


@pytest.fixture
def package(tmp_path: Path) -> Path:
    (tmp_path / "robot").mkdir()
    (tmp_path / "robot" / "package.xml").write_text(PACKAGE)
    (tmp_path / "tmp").mkdir()
    return tmp_path / "robot"


def command_line(package: Path, address: str) -> list[str]:
    words = ["check", str(package), "--cluster", address]
    return [sys.executable, "-m", "scaffold.cli.main", *words]


def check(
    package: Path, address: str, more: Mapping[str, str] | None = None
) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        command_line(package, address),
        env={**variables(package.parent / "tmp"), **(more or {})},
        capture_output=True,
        text=True,
        check=False,
    )


def error_line(done: subprocess.CompletedProcess[str]) -> str:
    """Return the only output line of a failed run."""
    assert done.returncode == 2, done.stdout + done.stderr
    assert done.stdout == ""
    (line,) = done.stderr.splitlines()
    return line


def test_missing_scheduler(package: Path) -> None:
    line = error_line(check(package, "tcp://127.0.0.1:1"))
    assert "--cluster tcp://127.0.0.1:1: no scheduler answers within 10 s" in line
    assert "does its address begin with tcp:// or tls:// as its log shows?" in line


@pytest.mark.parametrize("address", ["nowhere.invalid:8786", "http://127.0.0.1:8786", "8786"])
def test_invalid_scheduler_address(package: Path, address: str) -> None:
    assert f"--cluster {address}: no scheduler answers" in error_line(check(package, address))


def test_scheduler_without_workers(package: Path, tmp_path: Path) -> None:
    with cluster(tmp_path, 0) as running:
        line = error_line(check(package, running.address))
    assert f"the scheduler has no workers; start some with: dask worker {running.address}" in line


def test_workers_with_another_version_of_the_tool(package: Path, tmp_path: Path) -> None:
    site = tmp_path / "site"
    site.mkdir()
    (site / "sitecustomize.py").write_text("import scaffold\nscaffold.__version__ = '0.0.7'\n")
    with cluster(tmp_path, 1, of_workers={"PYTHONPATH": f"{site}:{ROOT}"}) as running:
        line = error_line(check(package, running.address))
    assert f"has ros2-scaffold 0.0.7, and this machine ros2-scaffold {__version__}" in line
    assert line.endswith("install the same on all")


def test_workers_without_the_tool(package: Path, tmp_path: Path) -> None:
    site = tmp_path / "site"
    site.mkdir()
    (site / "sitecustomize.py").write_text("import sys\nsys.modules['scaffold'] = None\n")
    with cluster(tmp_path, 1, of_workers={"PYTHONPATH": str(site)}) as running:
        line = error_line(check(package, running.address))
    assert "has no ros2-scaffold" in line


def test_scheduler_dies_during_the_run(tmp_path: Path) -> None:
    """The report has the results received so far; standard error lists the other packages."""
    names = [f"robot_{number}" for number in range(12)]
    for name in names:
        (tmp_path / "src" / name).mkdir(parents=True)
        (tmp_path / "src" / name / "package.xml").write_text(PACKAGE.replace("robot", name))
    (tmp_path / "tmp").mkdir()
    with (
        cluster(tmp_path, 1) as running,
        subprocess.Popen(
            command_line(tmp_path / "src", running.address),
            env=variables(tmp_path / "tmp"),
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        ) as run,
    ):
        (worker,) = running.workers
        wait_until(lambda: "batch_process" in " ".join(processes_of(worker.tmp)))
        running.scheduler.process.kill()
        out, errors = run.communicate(timeout=PATIENCE)
    assert run.returncode == 2
    assert "Traceback" not in errors
    (line,) = (line for line in errors.splitlines() if "error:" in line)
    assert " not checked: the connection to the scheduler was lost: " in line
    for name in names:
        assert (f" {name}," in f"{line},") != (f"{name}/package.xml:" in out)


# -- TLS


def authority(directory: Path) -> Path:
    """Create a certificate authority and a certificate signed by it."""
    directory.mkdir()
    for words in (
        "req -x509 -newkey rsa:2048 -nodes -subj /CN=authority -keyout ca.key -out ca.pem",
        "req -newkey rsa:2048 -nodes -subj /CN=localhost -keyout own.key -out own.csr",
        "x509 -req -in own.csr -CA ca.pem -CAkey ca.key -CAcreateserial -out own.crt",
    ):
        subprocess.run(["openssl", *words.split()], cwd=directory, check=True, capture_output=True)
    both = (directory / "own.key").read_text() + (directory / "own.crt").read_text()
    (directory / "own.pem").write_text(both)
    return directory


def configuration(directory: Path, certificates: Path, trusted: Path) -> dict[str, str]:
    """Write the Dask configuration of docs/cluster.md; return the variables that select it."""
    directory.mkdir()
    own = certificates / "own.pem"
    (directory / "distributed.yaml").write_text(
        "distributed:\n  comm:\n    require-encryption: true\n    tls:\n"
        f"      ca-file: {trusted / 'ca.pem'}\n"
        f"      scheduler: {{cert: {own}}}\n"
        f"      worker: {{cert: {own}}}\n"
        f"      client: {{cert: {own}}}\n"
    )
    return {"DASK_CONFIG": str(directory)}


def test_tls_accepts_only_certificates_of_the_authority(package: Path, tmp_path: Path) -> None:
    ours, theirs = authority(tmp_path / "ours"), authority(tmp_path / "theirs")
    own = configuration(tmp_path / "own", ours, ours)
    stranger = configuration(tmp_path / "stranger", theirs, ours)
    mistrusting = configuration(tmp_path / "mistrusting", ours, theirs)
    with cluster(tmp_path, 1, of_all=own, flags=["--protocol", "tls"]) as running:
        assert running.address.startswith("tls://")
        allowed = check(package, running.address, own)
        assert allowed.returncode == 1, allowed.stderr
        assert "robot/package.xml:" in allowed.stdout
        line = error_line(check(package, running.address))
        assert "TLS is not configured; name the certificates in distributed.comm.tls" in line
        for other in (stranger, mistrusting):
            assert "certificate" in error_line(check(package, running.address, other)).lower()
        plain = running.address.replace("tls://", "tcp://")
        assert "no scheduler answers" in error_line(check(package, plain))
