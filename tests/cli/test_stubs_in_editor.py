"""A language server, started like an editor does, completes names from `stubs`."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from scaffold.cli.main import main
from tests.test_stubs import definitions_of

PROGRAM = """
from geometry_msgs.msg import Twist
import rclpy
from robot_interfaces.msg import Level

cmd = Twist()
cmd.linear.
Level().
Level.
rclpy.create_node('talker').create_pub
"""


class LanguageServer:
    """A client of a server that speaks the language server protocol on its standard streams."""

    def __init__(self, root: Path) -> None:
        program = Path(sys.executable).with_name("basedpyright-langserver")
        pipe = subprocess.PIPE
        self._process = subprocess.Popen([program, "--stdio"], stdin=pipe, stdout=pipe, cwd=root)
        self._number = 0
        folder = {"uri": root.as_uri(), "name": root.name}
        self.request(
            "initialize", processId=os.getpid(), capabilities={}, workspaceFolders=[folder]
        )
        self.notify("initialized")

    def close(self) -> None:
        """End the server."""
        self.request("shutdown")
        self.notify("exit")
        self._process.communicate(timeout=30)

    def notify(self, method: str, **params: object) -> None:
        """Send a notification."""
        self._send({"method": method, "params": params})

    def request(self, method: str, **params: object) -> Any:  # noqa: ANN401  JSON of any shape
        """Send a request; return its result."""
        self._number += 1
        self._send({"id": self._number, "method": method, "params": params})
        while True:
            message = self._receive()
            if "method" in message and "id" in message:  # a question of the server: no opinion
                items = message.get("params", {}).get("items", [])
                self._send({"id": message["id"], "result": [None for _ in items] or None})
            elif message.get("id") == self._number:
                return message["result"]

    def _send(self, message: dict[str, object]) -> None:
        assert self._process.stdin is not None
        body = json.dumps({"jsonrpc": "2.0", **message}).encode()
        self._process.stdin.write(b"Content-Length: %d\r\n\r\n%s" % (len(body), body))
        self._process.stdin.flush()

    def _receive(self) -> Any:  # noqa: ANN401  JSON of any shape
        assert self._process.stdout is not None
        length = 0
        while (line := self._process.stdout.readline().strip()) or not length:
            name, _, value = line.partition(b":")
            assert line, "the server has ended"
            if name.lower() == b"content-length":
                length = int(value)
        return json.loads(self._process.stdout.read(length))


@pytest.fixture(scope="module")
def program(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a program in a workspace with stubs and an interface package of its own."""
    root = tmp_path_factory.mktemp("workspace")
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(root)
        patch.delenv("AMENT_PREFIX_PATH", raising=False)
        definitions_of(root, {"msg/Level.msg": "uint8 FULL=255\nuint8 level\nbool is_low\n"})
        assert main(["stubs"]) == 0
    path = root / "program.py"
    path.write_text(PROGRAM)
    return path


@pytest.fixture(scope="module")
def server(program: Path) -> Iterator[LanguageServer]:
    """Return a server for this workspace, with the program open."""
    started = LanguageServer(program.parent)
    document = {"uri": program.as_uri(), "languageId": "python", "version": 1, "text": PROGRAM}
    started.notify("textDocument/didOpen", textDocument=document)
    yield started
    started.close()


@pytest.mark.parametrize(
    ("typed", "offered"),
    [
        ("cmd.linear.", {"x", "y", "z"}),
        ("Level().", {"level", "is_low"}),
        ("Level.", {"FULL"}),
        ("create_pub", {"create_publisher"}),
    ],
)
def test_fields_constants_and_methods_are_completed(
    typed: str, offered: set[str], server: LanguageServer, program: Path
) -> None:
    lines = PROGRAM.splitlines()
    number = next(at for at, line in enumerate(lines) if line.endswith(typed))
    position = {"line": number, "character": len(lines[number])}
    result = server.request(
        "textDocument/completion", textDocument={"uri": program.as_uri()}, position=position
    )
    assert offered <= {item["label"] for item in result["items"]}
