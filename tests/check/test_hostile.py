"""`check` on hostile packages: a diagnostic or silence, never a traceback or a hang."""

from __future__ import annotations

import json
import os
import pty
import resource
import socket
import subprocess
import sys
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import Any

import pytest

from scaffold.ament import verdict as style
from scaffold.ament.finding import FLAKE8
from scaffold.ament.settings import Settings
from scaffold.check.rules import registry
from scaffold.check.selection import Selection
from scaffold.check.session import Session
from scaffold.configuration import content
from scaffold.model.package import Package

MANIFEST = """<?xml version="1.0"?>
<package format="3">
  <name>hostile</name>
  <version>0.1.0</version>
  <description>Input that nobody would write by hand.</description>
  <maintainer email="ann@ros.example.org">Ann</maintainer>
  <license>Apache-2.0</license>
  <buildtool_depend>ament_cmake</buildtool_depend>
  <export><build_type>ament_cmake</build_type></export>
</package>
"""

PLACES = {
    "python": "hostile/node.py",
    "setup.py": "setup.py",
    "setup.cfg": "setup.cfg",
    "manifest": "package.xml",
    "cmake": "CMakeLists.txt",
    "message": "msg/Odd.msg",
    "service": "srv/Odd.srv",
    "launch": "launch/odd.launch.py",
    "launch xml": "launch/odd.launch.xml",
    "launch yaml": "launch/odd.launch.yaml",
    "parameters": "config/odd.yaml",
    "changelog": "CHANGELOG.rst",
}

NESTED = 4000
LONG = 10_000_000

BYTES = {
    "empty": b"",
    "nul": b"\0" * 4096,
    "nul inside": b"# a\n\0\n# b\n",
    "not utf-8": b"# caf\xe9 \xff\xfe\n",
    "unknown encoding": b"# -*- coding: no-such-codec -*-\n<?xml version='1.0' encoding='x-no'?>\n",
    "utf-16": "# text\n<a/>\n".encode("utf-16"),
    "bom": b"\xef\xbb\xbf# text\n",
    "two boms": b"\xef\xbb\xbf\xef\xbb\xbf# text\n",
    "crlf": b"# one\r\n# two\r\n",
    "lone cr": b"# one\r# two\r",
    "mixed ends": b"# one\r# two\r\n# three\n\x0c\x0b\x1c\xc2\x85\xe2\x80\xa8# four",
    "surrogate": b"# \xed\xa0\x80\n",
    "brackets": b"(" * NESTED,
    "unclosed quote": b'"""\n' + b"'" * NESTED,
    "minus": b"-" * NESTED + b"1",
    "backslashes": b"\\" * NESTED + b"\n" + b"\\\n" * NESTED,
}

NESTS = {
    "python": b"x = " + b"(" * NESTED + b"1" + b")" * NESTED + b"\n",
    "setup.py": b"from setuptools import setup\nsetup(name=" + b"[" * 150 + b"]" * 150 + b")\n",
    "manifest": b"<a>" * NESTED + b"</a>" * NESTED,
    "cmake": b"project(hostile)\nif("
    + b"(" * NESTED
    + b"A"
    + b")" * NESTED
    + b")\nendif()\n"
    + b"if(A)\n" * NESTED
    + b"endif()\n" * NESTED,
    "message": b"int32" + b"[" * NESTED + b"]" * NESTED + b" values\n",
    "launch": b"x = " + b"[" * NESTED + b"]" * NESTED + b"\n",
    "launch xml": b"<launch>" + b"<group>" * NESTED + b"</group>" * NESTED + b"</launch>",
    "launch yaml": b"launch: " + b"[" * NESTED + b"]" * NESTED + b"\n",
    "parameters": b"a: " + b"{a: " * NESTED + b"1" + b"}" * NESTED + b"\n",
    "setup.cfg": b"[" * NESTED + b"a" + b"]" * NESTED + b"\n",
}

CHAINS = {
    "sum": b"x = " + b"1 + " * NESTED + b"1\n",
    "attributes": b"x = a" + b".b" * NESTED + b"\n",
    "calls": b"x = f" + b"()" * NESTED + b"\n",
    "conditions": b"if a:\n    pass\n" + b"elif a:\n    pass\n" * NESTED,
    "names": b"import rclpy\nx0 = 1\n"
    + b"".join(b"x%d = x%d + x%d\n" % (n + 1, n, n) for n in range(NESTED)),
}

LINES = {
    "python": b"x = '" + b"a" * LONG + b"'\n",
    "manifest": b"<package format='3'><name>" + b"a" * LONG + b"</name></package>",
    "cmake": b"project(" + b"a " * (LONG // 2) + b")",
    "message": b"int32 " + b"a" * LONG,
    "parameters": b"a: " + b"a" * LONG,
    "setup.cfg": b"[a]\nb = " + b"a" * LONG,
}

LAUGHS = (
    b'<?xml version="1.0"?>\n<!DOCTYPE package [\n<!ENTITY a0 "ha">\n'
    + b"".join(b'<!ENTITY a%d "%s">\n' % (n, b"&a%d;" % (n - 1) * 10) for n in range(1, 20))
    + b']>\n<package format="3"><name>&a19;</name></package>\n'
)

YAML_LAUGHS = b"a0: &a0 [ha]\n" + b"".join(
    b"a%d: &a%d [%s]\n" % (n, n, b", ".join([b"*a%d" % (n - 1)] * 10)) for n in range(1, 20)
)


@pytest.fixture(autouse=True)
def _no_results(own_cache: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Start each test without results of others."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(own_cache))


def _package(directory: Path, files: dict[str, bytes]) -> Path:
    """Write a package and return its directory."""
    given = {
        "package.xml": MANIFEST.encode(),
        "CMakeLists.txt": b"cmake_minimum_required(VERSION 3.8)\nproject(hostile)\n",
        **files,
    }
    for path, data in given.items():
        (directory / path).parent.mkdir(parents=True, exist_ok=True)
        (directory / path).write_bytes(data)
    return directory


def _run(*arguments: str | os.PathLike[str]) -> subprocess.CompletedProcess[bytes]:
    """Run ``check`` with memory for only a few of the largest files."""

    def limit() -> None:
        resource.setrlimit(resource.RLIMIT_AS, (4 << 30, 4 << 30))

    done = subprocess.run(
        [sys.executable, "-m", "scaffold", "check", *arguments],
        env={**os.environ, "SCAFFOLD_DEBUG": "1"},
        check=False,
        stdin=subprocess.DEVNULL,
        capture_output=True,
        preexec_fn=limit,
    )
    assert b"Traceback" not in done.stderr, done.stderr.decode(errors="replace")[-2000:]
    return done


def _check(package: Path) -> list[dict[str, Any]]:
    """Return the findings about a package."""
    done = _run("--format", "json", package)
    assert done.returncode in {0, 1}, (done.stdout[-1500:], done.stderr[-1500:])
    result: list[dict[str, Any]] = json.loads(done.stdout)["diagnostics"]
    assert "SC002" not in {finding["code"] for finding in result}
    return result


@pytest.mark.parametrize("kind", BYTES)
def test_bytes_everywhere(tmp_path: Path, kind: str) -> None:
    """The same odd bytes in every file except the manifest."""
    files = {path: BYTES[kind] for name, path in PLACES.items() if name != "manifest"}
    _check(_package(tmp_path, files))


@pytest.mark.parametrize("kind", BYTES)
def test_bytes_as_manifest(tmp_path: Path, kind: str) -> None:
    """A manifest that is no XML, or is preceded by odd bytes."""
    findings = _check(_package(tmp_path, {"package.xml": BYTES[kind]}))
    assert "package.xml" in {finding["path"].rpartition("/")[2] for finding in findings}


@pytest.mark.parametrize("place", NESTS)
def test_deep_nesting(tmp_path: Path, place: str) -> None:
    """Nesting deeper than the recursion limit."""
    _check(_package(tmp_path, {PLACES[place]: NESTS[place]}))


@pytest.mark.parametrize("kind", CHAINS)
def test_deep_syntax_trees(tmp_path: Path, kind: str) -> None:
    """Deep syntax trees without brackets, or values that double."""
    _check(_package(tmp_path, {PLACES["python"]: CHAINS[kind], PLACES["launch"]: CHAINS[kind]}))


@pytest.mark.parametrize("place", LINES)
def test_one_long_line(tmp_path: Path, place: str) -> None:
    """Ten megabytes without a line end."""
    _check(_package(tmp_path, {PLACES[place]: LINES[place]}))


@pytest.mark.parametrize("place", ["manifest", "launch xml"])
def test_xml_entities_are_not_expanded(tmp_path: Path, place: str) -> None:
    """Twenty lines of XML that would expand to 10^19 words."""
    _check(_package(tmp_path, {PLACES[place]: LAUGHS}))


@pytest.mark.parametrize("place", ["parameters", "launch yaml"])
def test_yaml_aliases_are_not_expanded(tmp_path: Path, place: str) -> None:
    """The same in YAML."""
    _check(_package(tmp_path, {PLACES[place]: YAML_LAUGHS}))


@pytest.mark.parametrize("obstacle", ["pipe", "/dev/zero", "loop", ".", "directory"])
@pytest.mark.parametrize("group", [0, 1])
def test_only_regular_files_are_read(tmp_path: Path, group: int, obstacle: str) -> None:
    """A pipe without a writer, an endless device, a symlink loop, and a directory.

    They replace half of the files at a time, since a missing file would hide others.
    """
    package = _package(tmp_path, {})
    for place in [place for place in PLACES if place != "manifest"][group::2]:
        name = package / PLACES[place]
        name.parent.mkdir(parents=True, exist_ok=True)
        name.unlink(missing_ok=True)
        if obstacle == "pipe":
            os.mkfifo(name)
        elif obstacle == "directory":
            name.mkdir()
        else:
            name.symlink_to(name.name if obstacle == "loop" else obstacle)
    _check(package)


@pytest.mark.parametrize("name", ["package.xml", "node.py"])
def test_pipe_named_on_the_command_line(tmp_path: Path, name: str) -> None:
    """A pipe is not waited for."""
    os.mkfifo(tmp_path / name)
    for path in (tmp_path / name, tmp_path):
        assert _run(path).returncode == 2


def test_loop_of_directories(tmp_path: Path) -> None:
    """Links to directories are not followed."""
    package = _package(tmp_path, {"hostile/__init__.py": b""})
    (package / "hostile" / "up").symlink_to(package)
    (package / "left").symlink_to("right")
    (package / "right").symlink_to("left")
    _check(package)


@pytest.mark.skipif(os.geteuid() == 0, reason="root reads everything")
def test_unreadable_file_and_directory(tmp_path: Path) -> None:
    """A file and a directory without permission."""
    package = _package(tmp_path, {"hostile/node.py": b"x = 1\n", "launch/a.launch.py": b""})
    (package / "hostile" / "node.py").chmod(0)
    (package / "launch").chmod(0)
    try:
        _check(package)
    finally:
        (package / "launch").chmod(0o755)


def test_odd_names(tmp_path: Path) -> None:
    """Undecodable names, names with newlines or escapes, and names of maximum length."""
    package = _package(tmp_path / "package", {})
    names = [b"caf\xe9.py", b"a\nb.py", b"a\x1b[31mb.py", b"n" * 252 + b".py", b"-x.py", b" .py"]
    for name in names:
        with open(os.path.join(os.fsencode(package), name), "wb") as file:
            file.write(b"import os\n")
    paths = {finding["path"] for finding in _check(package) if finding["code"] == "F401"}
    assert len(paths) == len(names)
    done = _run(package)
    assert done.returncode == 1
    text = done.stdout.decode()
    assert "\x1b" not in text
    assert "caf\\xe9.py:1:1: " in text
    assert "a\\nb.py:1:1: " in text


def test_odd_directories(tmp_path: Path) -> None:
    """Packages in directories with undecodable names, newlines or escapes."""
    for name in (b"caf\xe9", b"a\nb", b"a\x1b[31mb"):
        package = Path(os.fsdecode(os.path.join(os.fsencode(tmp_path), name)))
        _package(package, {"hostile/node.py": b"import os\n", "caf\udce9.py": b"x = 1 \n"})
        assert "F401" in {finding["code"] for finding in _check(package)}
        for arguments in (("--diff",), ("--fix",)):
            done = _run(*arguments, package)
            assert done.returncode == 1
            assert b"\x1b" not in done.stdout + done.stderr
        done = _run(package / "nothing")
        assert done.returncode == 2
        assert b"\x1b" not in done.stderr
        assert done.stderr.count(b"\n") == 1


def test_control_characters_in_files_are_escaped_on_terminals(tmp_path: Path) -> None:
    """A patch is exact in a file and escaped on a terminal."""
    package = _package(tmp_path, {"node.py": b"X = '\x1b[2J\xc2\x9b'  \n"})
    assert b"+X = '\x1b[2J\xc2\x9b'\n" in _run("--diff", package).stdout
    leader, follower = pty.openpty()
    with subprocess.Popen(
        [sys.executable, "-m", "scaffold", "check", "--diff", package],
        stdin=subprocess.DEVNULL,
        stdout=follower,
        stderr=follower,
        env={**os.environ, "NO_COLOR": "1"},
    ):
        os.close(follower)
        shown = b""
        with suppress(OSError):  # the end of a terminal is an error
            while part := os.read(leader, 1 << 16):
                shown += part
    os.close(leader)
    assert b"\\x1b[2J\\x9b" in shown
    assert b"\x1b" not in shown
    assert b"\xc2\x9b" not in shown


@pytest.mark.parametrize("place", PLACES)
def test_too_large_file(tmp_path: Path, place: str) -> None:
    """Three megabytes of any kind: the content is not checked."""
    findings = _check(_package(tmp_path, {PLACES[place]: b"# " + b"x \n" * 1_000_000}))
    here = {finding["code"] for finding in findings if finding["path"].endswith(PLACES[place])}
    about_the_file = {"SC004", "E902", "LY006", "LY020", "PX050"}
    assert here <= about_the_file


@pytest.mark.parametrize("place", ["CMakeLists.txt", "package.xml"])
def test_too_long_line(tmp_path: Path, place: str) -> None:
    """A line of 60 kB is within the size limit of files, but nobody writes such a line."""
    findings = _check(_package(tmp_path, {place: b"x;" * 30_000}))
    (item,) = (finding for finding in findings if finding["code"] == "SC004")
    assert item["path"].endswith(place)
    assert item["message"].startswith("a line of 60 kB; the limit is 20 kB")


TINY = {
    "manifest": (b"<a/>\n" * 6_000, "30000 tokens; the limit is 20000"),
    "setup.cfg": (b"a=b\n" * 6_000, "24000 tokens; the limit is 20000"),
    "cmake": (b"f()\n" * 8_000, "32000 tokens; the limit is 30000"),
    "service": (b"a\n" * 60_000, ""),
}


@pytest.mark.parametrize("place", TINY)
def test_too_many_words(tmp_path: Path, place: str) -> None:
    """The time depends on the number of words, which has its own limit in code."""
    data, message = TINY[place]
    findings = _check(_package(tmp_path, {PLACES[place]: data}))
    messages = [finding["message"] for finding in findings if finding["code"] == "SC004"]
    assert messages == ([f"{message}: the file is not checked"] if message else [])


@pytest.mark.parametrize("place", ["launch xml", "launch yaml"])
def test_large_launch_files_are_not_read(tmp_path: Path, place: str) -> None:
    """They are decoded in another way, with the same limit as all other files."""
    node = {"launch xml": b"<node pkg='a' exec='b'/>\n", "launch yaml": b"- node: {pkg: a}\n"}
    head = {"launch xml": b"<launch>\n", "launch yaml": b"launch:\n"}
    tail = {"launch xml": b"</launch>\n", "launch yaml": b""}
    data = head[place] + node[place] * 60_000 + tail[place]
    findings = _check(_package(tmp_path, {PLACES[place]: data}))
    codes = {finding["code"] for finding in findings if finding["path"].endswith(PLACES[place])}
    assert codes == {"SC004"}


def test_too_many_words_for_style_checks(tmp_path: Path) -> None:
    findings = _check(_package(tmp_path, {"hostile/node.py": b"x\n" * 60_000}))
    messages = [finding["message"] for finding in findings if finding["code"] == "SC004"]
    assert {finding["code"] for finding in findings if finding["path"].endswith("node.py")} <= {
        "SC004",
        "LY020",
    }
    assert messages == ["120000 tokens; the limit is 100000: the file is not checked"]


OVERSIZED = {
    "a block": ("x = 1\n" * 4001, "4001 statements in one block; the limit is 4000"),
    "inner blocks": (
        "def f(a):\n    if a:\n        a = 1\n    else:\n" + "        a = 2\n" * 4500,
        "4500 statements in one block; the limit is 4000",
    ),
    "a tree": (
        "a + a + a + a + a\n" * 6000,
        "a syntax tree of 60001 nodes; the limit is 60000",
    ),
}


@pytest.mark.parametrize("name", OVERSIZED)
def test_too_much_repeated_code(tmp_path: Path, name: str) -> None:
    """A few words repeated thousands of times: one diagnostic for rules and style alike."""
    text, message = OVERSIZED[name]
    findings = _check(_package(tmp_path, {"hostile/node.py": text.encode()}))
    here = [item for item in findings if item["path"].endswith("node.py")]
    messages = [item["message"] for item in here if item["code"] != "LY020"]
    assert messages == [f"{message}: the file is not checked"]


def test_the_largest_files_that_people_write_are_checked(tmp_path: Path) -> None:
    text = "".join(f"X{at} = {{'key': [{at}, {at}.0], 'name': 'a'}}\n" for at in range(3900))
    findings = _check(_package(tmp_path, {"hostile/node.py": f"{text}import os\n".encode()}))
    codes = {item["code"] for item in findings if item["path"].endswith("node.py")}
    assert "SC004" not in codes
    assert {"E402", "F401"} <= codes


def test_too_long_line_for_style_checks(tmp_path: Path) -> None:
    findings = _check(_package(tmp_path, {"hostile/node.py": b"x;" * 30_000}))
    codes = {finding["code"] for finding in findings if finding["path"].endswith("node.py")}
    assert codes <= {"SC004", "LY020"}


def test_too_many_findings(tmp_path: Path) -> None:
    """The number of findings is limited, with a note."""
    findings = _check(_package(tmp_path, {"hostile/node.py": b"# x  \n" * 6000}))
    assert sum(finding["code"] == "W291" for finding in findings) == 5000
    (item,) = (finding for finding in findings if finding["code"] == "SC005")
    assert item["line"] == 5001


_IMPORTS = "import rclpy\nfrom rclpy.node import Node\nfrom std_msgs.msg import String\n"
_NODE = f"{_IMPORTS}class A(Node):\n    def __init__(self):\n        super().__init__('a')\n"
_PROJECT = "cmake_minimum_required(VERSION 3.8)\nproject(hostile)\n"
REPEATED = {
    "parameters of other names": (
        "hostile/node.py",
        _NODE,
        "        self.declare_parameter('some{0}', 1)\n        self.get_parameter('som{0}')\n",
    ),
    "attributes of other names": (
        "hostile/node.py",
        _NODE,
        "        self.some_{0} = 1\n        print(self.som_{0})\n",
    ),
    "attributes that are added to": ("hostile/node.py", _NODE, "        self.sum += {0}\n"),
    "statements": ("hostile/node.py", f"{_IMPORTS}def f(n):\n", "    rclpy.spin(n)\n"),
    "statements behind return": (
        "hostile/node.py",
        f"{_IMPORTS}def f(n):\n    return\n",
        "    n.x()\n",
    ),
    "values of a name": (
        "hostile/node.py",
        f"{_IMPORTS}def f():\n",
        "    m = String()\n    m.data = 'a'\n",
    ),
    "classes": ("hostile/node.py", _IMPORTS, "class A{0}(Node):\n    pass\n"),
    "targets of other names": (
        "CMakeLists.txt",
        _PROJECT,
        "add_library(some{0} a.cpp)\ntarget_link_libraries(som{0} b)\n",
    ),
    "dependencies of interfaces": (
        "CMakeLists.txt",
        f"{_PROJECT}rosidl_generate_interfaces(hostile DEPENDENCIES\n",
        "  a{0}\n",
    ),
    "blanks before parentheses": ("CMakeLists.txt", _PROJECT, 'set(x "" "" )\n'),
    "upper case": ("CMakeLists.txt", _PROJECT, "SET(A B)\n"),
}


@pytest.mark.parametrize("kind", REPEATED)
def test_steps_are_linear_in_the_number_of_lines(kind: str) -> None:
    """Four times the lines take four times the calls, not sixteen times."""
    path, head, line = REPEATED[kind]
    rules = registry.load(content.roots("rules", ()))
    session = Session(rules, Selection(select=tuple({rule.code[:2] for rule in rules})))

    def steps(count: int) -> int:
        text = head + "".join(line.format(number) for number in range(count))
        package = Package.of({"package.xml": MANIFEST, "CMakeLists.txt": _PROJECT, path: text})
        calls = 0

        def note(*_: object) -> None:
            nonlocal calls
            calls += 1

        sys.setprofile(note)
        try:
            session.check(package)
        finally:
            sys.setprofile(None)
        return calls

    assert steps(1200) < 6 * steps(300)


@pytest.mark.parametrize("line", ["x;", "[1 ,2 ],", "( x ),"])
def test_style_steps_are_linear_in_the_length_of_a_line(line: str) -> None:
    """A line four times as long takes four times the steps of the style rules."""

    def steps(count: int) -> int:
        data = (line * count + "\n").encode()
        taken = 0

        def note(*_: object) -> Callable[..., Any]:
            nonlocal taken
            taken += 1
            return note

        before = sys.gettrace()
        sys.settrace(note)
        try:
            findings = style.check("node.py", data, list, [Settings(FLAKE8)])
        finally:
            sys.settrace(before)
        assert {item.line for item in findings} == {1}
        return taken

    assert steps(800) < 6 * steps(200)


def test_files_removed_during_the_check(tmp_path: Path) -> None:
    """Every file is removed between listing and reading."""
    package = Package.at(_package(tmp_path, dict.fromkeys(PLACES.values(), b"x = 1\n")))
    assert package.files
    for path in package.files:
        (tmp_path / path).unlink()
    rules = registry.load(content.roots("rules", ()))
    diagnostics = Session(rules, Selection()).check(package)
    assert "SC002" not in {finding.code for finding in diagnostics}


def test_sockets_are_no_files(tmp_path: Path) -> None:
    """A socket named like a source file."""
    package = _package(tmp_path, {})
    with socket.socket(socket.AF_UNIX) as listening:
        listening.bind(str(package / "a.py"))
        _check(package)


def test_many_files(tmp_path: Path) -> None:
    """Two thousand files of one package."""
    files = {f"hostile/m{n}/f{n}.py": b"import os\n" for n in range(1000)}
    files |= {f"config/c{n}.yaml": b"a: 1\n" for n in range(1000)}
    findings = _check(_package(tmp_path, files))
    assert sum(finding["code"] == "F401" for finding in findings) == 1000
