"""Transactions: no data is lost when a run is killed or another process writes too."""

from __future__ import annotations

import fcntl
import os
import shutil
import signal
import stat
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import pytest

from scaffold.cli.main import main
from scaffold.errors import ConflictError, InputError, LockedError
from scaffold.files import cache, temporary
from scaffold.writing import lock, rename, stage, transaction
from scaffold.writing.plan import WritePlan

PERSON = ("--maintainer-name", "Ada", "--maintainer-email", "ada@example.com")
BEFORE = {
    "a": "old a\n",
    "b/c": "old c\n",
    "gone": "old\n",
    transaction.BASES: "old bases\n",
    transaction.RECORD: "old record\n",
}
AFTER = {
    "a": "new a\n",
    "b/c": "new c\n",
    "d/e/f": "new f\n",
    transaction.BASES: "new bases\n",
    transaction.RECORD: "new record\n",
}
TOP = [transaction.BASES, transaction.RECORD, "a", "b", "gone"]

CALLS = ("open", "mkdir", "rename", "replace", "unlink", "rmdir", "fsync", "fchmod", "link")
"""What changes something on a disk."""

STEPS = ["at once", "in steps"]
"""How two files are exchanged: by the kernel, or as on file systems that cannot do it."""


def tree(root: Path) -> dict[str, str]:
    return {
        path.relative_to(root).as_posix(): path.read_text()
        for path in sorted(root.rglob("*"))
        if path.is_file()
    }


def write(root: Path, files: dict[str, str]) -> Path:
    for path, text in files.items():
        (root / path).parent.mkdir(parents=True, exist_ok=True)
        (root / path).write_text(text)
    return root


def killed_writer(
    root: Path, at: int, how: str = "at once", around: dict[str, str] | None = None
) -> bool:
    """Write in a process that kills itself before the n-th step; return whether it was killed."""
    process = os.fork()
    if process == 0:
        try:
            plan = WritePlan.of(root, AFTER, remove=["gone"])
            outer = WritePlan.of(root.parents[1], around) if around else None
            _count_down(at)
            if how == "in steps":
                vars(rename)["try_rename"] = lambda *_: False
            plan.write(force=True, around=outer)
        finally:
            os._exit(0)
    _, status = os.waitpid(process, 0)
    return os.WIFSIGNALED(status)


def _count_down(at: int) -> None:
    """Replace the functions that change files: the n-th call of any of them kills this process."""
    steps = iter(range(1, at))

    def counted(function: Callable[..., Any]) -> Callable[..., Any]:
        def call(*arguments: object, **options: object) -> object:
            if next(steps, None) is None:
                os.kill(os.getpid(), signal.SIGKILL)
            return function(*arguments, **options)

        return call

    for name in CALLS:
        setattr(os, name, counted(getattr(os, name)))
    vars(rename)["try_rename"] = counted(rename.try_rename)


def heal(root: Path) -> list[str]:
    notes: list[str] = []
    with transaction.exclusive(str(root), notes.append):
        pass
    return notes


def killed_states(root: Path, how: str = "at once") -> Iterator[int]:
    """Yield each step at which a writer can be killed, and leave its files in ``root``."""
    for at in range(1, 200):
        shutil.rmtree(root, ignore_errors=True)
        write(root, BEFORE)
        if not killed_writer(root, at, how):
            assert tree(root) == AFTER
            return
        yield at
    pytest.fail("the writer never ends")


@pytest.mark.parametrize("how", STEPS)
def test_write_killed_at_any_step_is_completed_or_undone(tmp_path: Path, how: str) -> None:
    outcomes: set[str] = set()
    for at in killed_states(tmp_path / "p", how):
        is_unfinished = transaction.is_unfinished(str(tmp_path / "p"))
        notes = heal(tmp_path / "p")
        assert tree(tmp_path / "p") in (BEFORE, AFTER), at
        assert bool(notes) == is_unfinished
        assert not [name for name in os.listdir(tmp_path / "p") if temporary.is_temporary(name)]
        assert (tmp_path / "p" / "d").exists() == (tree(tmp_path / "p") == AFTER)
        outcomes.update(note.rpartition(" ")[2] for note in notes)
        assert heal(tmp_path / "p") == []
    assert outcomes == {"completed", "undone"}


AROUND_BEFORE = {"hooks": "old\n", "src/other/a": "theirs\n"}
AROUND_AFTER = {"hooks": "new\n", ".github/workflows/p": "new\n"}


@pytest.mark.parametrize("how", STEPS)
def test_files_outside_the_package_are_in_the_same_transaction(tmp_path: Path, how: str) -> None:
    top = tmp_path / "top"
    before = {**AROUND_BEFORE, **{f"src/p/{path}": text for path, text in BEFORE.items()}}
    after = {**AROUND_BEFORE, **AROUND_AFTER, **{f"src/p/{name}": AFTER[name] for name in AFTER}}
    outcomes: set[str] = set()
    for at in range(1, 200):
        shutil.rmtree(top, ignore_errors=True)
        write(top, before)
        if not killed_writer(top / "src" / "p", at, how, AROUND_AFTER):
            break
        notes = heal(top / "src" / "p")
        assert tree(top) in (before, after), at
        assert (top / ".github").exists() == (tree(top) == after)
        outcomes.update(note.rpartition(" ")[2] for note in notes)
    assert tree(top) == after
    assert outcomes == {"completed", "undone"}


def test_new_package_and_files_outside_of_it_are_one_transaction(tmp_path: Path) -> None:
    top = tmp_path / "top"
    after = {**AROUND_BEFORE, **AROUND_AFTER, **{f"src/p/{name}": AFTER[name] for name in AFTER}}
    outcomes: set[str] = set()
    for at in range(1, 200):
        shutil.rmtree(top, ignore_errors=True)
        write(top, AROUND_BEFORE)
        if not killed_writer(top / "src" / "p", at, around=AROUND_AFTER):
            break
        notes = heal(top / "src" / "p") if (top / "src" / "p").exists() else []
        stage.sweep(str(top / "src"))
        assert tree(top) in (AROUND_BEFORE, after), at
        outcomes.update(note.rpartition(" ")[2] for note in notes)
    assert tree(top) == after
    assert outcomes == {"completed"}


def test_new_package_is_removed_when_a_file_outside_of_it_changes(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    write(tmp_path, AROUND_BEFORE)
    exchange = rename.exchange

    def late(first: str, second: str, spare: str) -> None:
        (tmp_path / "hooks").write_text("mine\n")
        exchange(first, second, spare)

    monkeypatch.setattr(rename, "exchange", late)
    around = WritePlan.of(tmp_path, AROUND_AFTER)
    with pytest.raises(ConflictError, match=f"^{tmp_path}/hooks changed after it was read"):
        WritePlan.of(tmp_path / "src" / "p", AFTER).write(force=True, around=around)
    assert tree(tmp_path) == {**AROUND_BEFORE, "hooks": "mine\n"}
    assert sorted(os.listdir(tmp_path)) == ["hooks", "src"]
    assert os.listdir(tmp_path / "src") == ["other"]


def test_file_on_another_file_system_is_rejected_before_writing(tmp_path: Path) -> None:
    memory = Path("/dev/shm")  # noqa: S108  its own file system on every Linux
    if not memory.is_dir() or memory.stat().st_dev == tmp_path.stat().st_dev:
        pytest.skip("needs two file systems")
    write(tmp_path, BEFORE)
    with TemporaryDirectory(dir=memory) as other:
        write(Path(other), {"hooks": "old\n"})
        around = WritePlan.of(other, {"hooks": "new\n"})
        with pytest.raises(InputError, match=f"^{other}/hooks is on a different file system than"):
            WritePlan.of(tmp_path, AFTER).write(force=True, around=around)
        assert tree(Path(other)) == {"hooks": "old\n"}
    assert tree(tmp_path) == BEFORE


def test_journal_of_another_user_does_not_change_files_outside_the_package(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    root = write(tmp_path / "src" / "p", BEFORE)
    write(tmp_path, {"hooks": "old\n"})
    at = 1
    while not transaction.is_unfinished(str(root)):
        assert killed_writer(root, at, around={"hooks": "new\n"})
        at += 1
    user = os.geteuid()
    monkeypatch.setattr(os, "geteuid", lambda: user + 1)
    (note,) = heal(root)
    assert note.endswith("ignored; remove it")
    monkeypatch.undo()
    (note,) = heal(root)
    assert note.endswith("undone")


def test_sidecar_and_record_are_written_last(tmp_path: Path) -> None:
    root = tmp_path / "p"
    for _ in killed_states(root):
        if (root / transaction.BASES).read_text() == AFTER[transaction.BASES]:
            assert {**tree(root), transaction.RECORD: ""}.items() >= {
                **AFTER,
                transaction.RECORD: "",
            }.items()
        if (root / transaction.RECORD).read_text() == AFTER[transaction.RECORD]:
            assert tree(root).items() >= AFTER.items()


def test_edits_after_a_crash_are_kept(tmp_path: Path) -> None:
    root = tmp_path / "p"
    for at in killed_states(root):
        (root / "b" / "c").write_text("mine\n")
        notes = heal(root)
        assert (root / "b" / "c").read_text() == "mine\n", at
        if notes:
            assert notes[0].endswith("edited since, not restored: b/c"), at
        others = {path: text for path, text in tree(root).items() if path != "b/c"}
        assert others in [
            {path: text for path, text in state.items() if path != "b/c"}
            for state in (BEFORE, AFTER)
        ], at


def test_restored_file_gets_a_new_modification_time(tmp_path: Path) -> None:
    root = tmp_path / "p"
    undone = 0
    for _ in killed_states(root):
        crashed = (root / "a").read_text() == AFTER["a"]
        os.utime(root / "a", (1_000_000_000, 1_000_000_000))
        notes = heal(root)
        if crashed and notes and notes[0].endswith("undone"):
            undone += 1
            assert (root / "a").stat().st_mtime > 1_500_000_000
    assert undone


def test_copied_journal_is_ignored(tmp_path: Path) -> None:
    root, copy = tmp_path / "p", tmp_path / "copy"
    for _ in killed_states(root):
        if transaction.is_unfinished(str(root)):
            break
    shutil.copytree(root, copy)
    before = {path: path.read_bytes() for path in copy.rglob("*") if path.is_file()}
    (note,) = heal(copy)
    assert note.endswith("ignored; remove it")
    assert {path: path.read_bytes() for path in copy.rglob("*") if path.is_file()} == before


@pytest.mark.parametrize("how", STEPS)
def test_file_changed_before_its_rename_aborts_the_transaction(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, how: str
) -> None:
    write(tmp_path, BEFORE)
    if how == "in steps":
        monkeypatch.setattr(rename, "try_rename", lambda *_: False)
    exchange = rename.exchange
    seen: list[str] = []

    def late(first: str, second: str, spare: str) -> None:
        if not seen:
            (tmp_path / "b" / "c").write_text("mine\n")  # after all files were compared
        seen.append(second)
        exchange(first, second, spare)

    monkeypatch.setattr(rename, "exchange", late)
    with pytest.raises(ConflictError, match=r"b/c in .* changed after it was read"):
        WritePlan.of(tmp_path, AFTER, remove=["gone"]).write(force=True)
    assert len(seen) > 2
    assert tree(tmp_path) == {**BEFORE, "b/c": "mine\n"}
    assert sorted(os.listdir(tmp_path)) == TOP


def test_text_written_through_an_open_file_is_kept(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    write(tmp_path, BEFORE)
    exchange = rename.exchange
    with (tmp_path / "a").open("a") as editor:

        def late(first: str, second: str, spare: str) -> None:
            exchange(first, second, spare)
            editor.write("and more\n")
            editor.flush()

        monkeypatch.setattr(rename, "exchange", late)
        with pytest.raises(ConflictError, match=r"a in .* changed after it was read"):
            WritePlan.of(tmp_path, {"a": "new\n"}).write(force=True)
    assert (tmp_path / "a").read_text().startswith("old a\nand more\n")


@pytest.mark.parametrize("change", ["edited", "gone", "appeared", "executable"])
def test_file_changed_after_planning_aborts_before_the_first_write(
    tmp_path: Path, change: str
) -> None:
    write(tmp_path, BEFORE)
    plan = WritePlan.of(tmp_path, AFTER, remove=["gone"])
    path = {"gone": "gone", "appeared": "d/e/f"}.get(change, "b/c")
    if change == "gone":
        (tmp_path / "gone").unlink()
    elif change == "executable":
        (tmp_path / path).chmod(0o755)
    else:
        write(tmp_path, {path: "mine\n"})
    before = tree(tmp_path)
    times = {file: file.stat().st_ctime_ns for file in tmp_path.rglob("*") if file.is_file()}
    with pytest.raises(
        ConflictError, match=f"^{path} in .*nothing was written; run the command again"
    ):
        plan.write(force=True)
    assert tree(tmp_path) == before
    assert {file: file.stat().st_ctime_ns for file in times} == times


@pytest.fixture
def package(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> Path:
    assert main(["new", "talker", "--destination-directory", str(tmp_path), *PERSON]) == 0
    capfd.readouterr()
    return tmp_path / "talker"


@contextmanager
def edit_during_the_check(path: Path, text: str) -> Iterator[None]:
    """Edit a file after a run has read the package and before it plans its writes."""
    of = WritePlan.of

    def late(*arguments: object, **options: object) -> WritePlan:
        with path.open("a") as file:
            file.write(text)
        return of(*arguments, **options)  # type: ignore[arg-type]  # as they came

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(WritePlan, "of", late)
        yield


def test_an_edit_during_add_is_not_lost(package: Path, capfd: pytest.CaptureFixture[str]) -> None:
    before = tree(package)
    with edit_during_the_check(package / "CMakeLists.txt", "# mine\n"):
        assert main(["add", "timer", "beat", "--package-directory", str(package)]) == 2
    assert "CMakeLists.txt in " in capfd.readouterr().err
    assert tree(package) == {**before, "CMakeLists.txt": before["CMakeLists.txt"] + "# mine\n"}


def test_an_edit_during_a_fix_is_not_lost(package: Path, capfd: pytest.CaptureFixture[str]) -> None:
    node = package / "talker" / "minimal_publisher.py"
    node.write_text(node.read_text() + "X = 1 \n")
    with edit_during_the_check(node, "MINE = 2\n"):
        assert main(["check", "--fix", str(package)]) == 2
    assert "changed after it was read; nothing was written" in capfd.readouterr().err
    assert node.read_text().endswith("X = 1 \nMINE = 2\n")


def test_a_file_that_appears_during_add_is_not_overwritten(package: Path) -> None:
    with edit_during_the_check(package / "talker" / "beat.py", "mine\n"):
        command = ["add", "timer", "beat", "--package-directory", str(package), "--force"]
        assert main(command) == 2
    assert (package / "talker" / "beat.py").read_text() == "mine\n"


def test_parallel_adds_are_all_applied(package: Path) -> None:
    names = [f"beat_{number}" for number in range(6)]
    command = [sys.executable, "-m", "scaffold", "add", "timer"]
    processes = [
        subprocess.Popen(
            [*command, name, "--package-directory", str(package)],
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            text=True,
        )
        for name in names
    ]
    errors = [process.communicate()[1] for process in processes]
    assert [process.returncode for process in processes] == [0] * len(names), errors
    files = tree(package)
    for name in names:
        for path in ("CMakeLists.txt", "README.md", transaction.RECORD):
            assert name in files[path]
        assert f"talker/{name}.py" in files


def test_waiting_names_the_holder_of_the_lock_and_times_out(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    write(tmp_path, BEFORE)
    monkeypatch.setattr(lock, "PATIENCE", 0.0)
    notes: list[str] = []
    with (
        holding(tmp_path) as process,
        pytest.raises(LockedError) as raised,
        transaction.exclusive(str(tmp_path), notes.append),
    ):
        pytest.fail("somebody else holds it")
    holder = f"process {process} ({sys.executable} -c "
    assert notes[0].startswith(f"waiting for {holder}")
    assert f"is locked by {holder}" in str(raised.value)
    assert "nothing was written" in str(raised.value)


def test_lock_of_killed_process_is_released(tmp_path: Path) -> None:
    with holding(tmp_path) as process:
        os.kill(process, signal.SIGKILL)
        with transaction.exclusive(str(tmp_path)):
            assert os.listdir(tmp_path) == []


@contextmanager
def holding(directory: Path) -> Iterator[int]:
    """Hold the lock of a directory in another process."""
    script = (
        "import sys\nfrom scaffold.writing import lock\n"
        "with lock.locked(sys.argv[1], print):\n    print('held', flush=True)\n    sys.stdin.read()"
    )
    with subprocess.Popen(
        [sys.executable, "-c", script, str(directory)],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
    ) as process:
        assert process.stdout is not None
        assert process.stdout.readline() == b"held\n"
        yield process.pid
        process.kill()


def test_lock_works_where_directories_cannot_be_locked(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    flock = fcntl.flock

    def flock_as_nfs(descriptor: int, operation: int) -> None:
        if stat.S_ISDIR(os.fstat(descriptor).st_mode):
            raise OSError(9, "Bad file descriptor")
        flock(descriptor, operation)

    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    monkeypatch.setattr(fcntl, "flock", flock_as_nfs)
    write(tmp_path / "p", BEFORE)
    WritePlan.of(tmp_path / "p", AFTER, remove=["gone"]).write(force=True)
    assert tree(tmp_path / "p") == AFTER
    monkeypatch.setattr(lock, "PATIENCE", 0.0)
    with (
        lock.locked(str(tmp_path / "p"), print),
        pytest.raises(LockedError),
        lock.locked(str(tmp_path / "p"), print),
    ):
        pytest.fail("it is locked")


def test_check_notes_an_interrupted_write_and_changes_nothing(
    package: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    at = next(at for at in range(1, 200) if killed_writer_left_a_journal(package, at))
    assert at
    before = tree(package)
    for _ in range(2):  # the second run would be a remembered one
        main(["check", str(package)])
        assert "note: " in (err := capfd.readouterr().err)
        assert "a run was interrupted while it changed this package" in err
    assert tree(package) == before
    main(["check", "--fix", str(package)])
    assert "an earlier run was interrupted; its changes were " in capfd.readouterr().err
    main(["check", str(package)])
    assert "cut off" not in capfd.readouterr().err


def killed_writer_left_a_journal(root: Path, at: int) -> bool:
    killed_writer(root, at)
    if transaction.is_unfinished(str(root)):
        return True
    heal(root)
    return False


def test_new_removes_leftovers_of_a_killed_new(tmp_path: Path) -> None:
    script = (
        "import os, signal, sys\nfrom scaffold.writing.plan import WritePlan\n"
        "os.rename = lambda *_: os.kill(os.getpid(), signal.SIGKILL)\n"
        "WritePlan.of(sys.argv[1], {'a/b': '1'}).write()"
    )
    done = subprocess.run([sys.executable, "-c", script, str(tmp_path / "p")], check=False)
    assert done.returncode == -signal.SIGKILL
    (left,) = tmp_path.iterdir()
    assert temporary.is_temporary(left.name)
    theirs = write(tmp_path / temporary.name(), {"thesis.txt": "mine"})
    with stage.Stage.made(str(tmp_path)) as alive:
        WritePlan.of(tmp_path / "p", {"a/b": "2"}).write()
        names = {path.name for path in tmp_path.iterdir()}
    assert names == {"p", theirs.name, os.path.basename(alive.path)}


def test_planted_symlink_is_not_followed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "victim").write_text("precious")
    kept = tmp_path / "kept"
    kept.mkdir()
    monkeypatch.setattr(temporary, "name", lambda: "guessed")
    for name in ("guessed", f"seal.{os.getpid()}"):
        (kept / name).symlink_to(tmp_path / "victim")
    assert not cache.write_sealed(str(kept / "seal"), b"head", b"data")
    with pytest.raises(InputError):
        WritePlan.of(kept, {"new": "1"}).write()
    assert (tmp_path / "victim").read_text() == "precious"


def test_a_file_keeps_its_mode_and_attributes_and_gets_a_new_time(tmp_path: Path) -> None:
    write(tmp_path, BEFORE)
    (tmp_path / "a").chmod(0o640)
    os.utime(tmp_path / "a", (1_000_000_000, 1_000_000_000))
    os.utime(tmp_path / "b" / "c", (1_000_000_000, 1_000_000_000))
    try:
        os.setxattr(tmp_path / "a", "user.note", b"kept")
    except OSError:
        pytest.skip("this file system has no extended attributes")
    WritePlan.of(tmp_path, {**BEFORE, "a": "new\n"}).write(force=True)
    status = (tmp_path / "a").stat()
    assert stat.S_IMODE(status.st_mode) == 0o640
    assert status.st_mtime > 1_500_000_000
    assert os.getxattr(tmp_path / "a", "user.note") == b"kept"
    assert (tmp_path / "b" / "c").stat().st_mtime == 1_000_000_000


@pytest.mark.skipif(os.geteuid() != 0, reason="only root can give files away")
def test_root_keeps_the_owners_of_files(tmp_path: Path) -> None:
    root = write(tmp_path / "p", BEFORE)
    for path in (tmp_path, root, *root.rglob("*")):
        os.chown(path, 1234, 2345)
    os.chown(root / "a", 3456, 2345)
    WritePlan.of(root, AFTER, remove=["gone"]).write(force=True)
    WritePlan.of(tmp_path / "q", {"r/s": ""}).write()
    owners = {
        path.relative_to(tmp_path).as_posix(): path.stat().st_uid for path in tmp_path.rglob("*")
    }
    assert owners.pop("p/a") == 3456
    assert set(owners.values()) == {1234}


def test_symlink_out_of_the_package_blocks_only_the_fix_of_that_file(
    package: Path, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    outside = tmp_path / "shared.py"
    outside.write_text("X = 1 \n")
    (package / "talker" / "shared.py").symlink_to(outside)
    node = package / "talker" / "minimal_publisher.py"
    node.write_text(node.read_text() + "X = 1 \n")
    assert main(["check", "--fix", str(package)]) in {0, 1}
    (line,) = [line for line in capfd.readouterr().err.splitlines() if "not fixed" in line]
    assert line.endswith(
        f"talker/shared.py: not fixed: a link to {outside}, outside of the package"
    )
    assert outside.read_text() == "X = 1 \n"
    assert not node.read_text().endswith(" \n")


def test_a_full_disk_leaves_the_old_files(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    write(tmp_path, BEFORE)
    fsync = os.fsync
    calls: list[int] = []

    def full(descriptor: int) -> None:
        calls.append(descriptor)
        if len(calls) > 1:
            raise OSError(28, "No space left on device")
        fsync(descriptor)

    monkeypatch.setattr(os, "fsync", full)
    with pytest.raises(InputError, match=r"No space left on device; nothing was written$"):
        WritePlan.of(tmp_path, AFTER, remove=["gone"]).write(force=True)
    assert tree(tmp_path) == BEFORE
    assert sorted(os.listdir(tmp_path)) == TOP
