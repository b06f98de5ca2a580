"""Random edits of a workspace, like those of people, editors and version control."""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Sequence
from pathlib import Path
from random import Random

Edit = Callable[[Path, Random], str]

_TEXTS = (
    *(".py", ".xml", ".txt", ".cfg", ".yaml", ".yml"),
    *(".msg", ".srv", ".action", ".urdf", ".xacro"),
)
_LINES = (
    "# a comment\n",
    "import os\n",
    "import rclpy\n",
    "from launch import LaunchDescription\n",
    "x = undefined  # noqa: F821\n",
    "def broken(:\n",
    "    pass\n",
    "class Base:\n    pass\n",
    "import rclpy.node\nrclpy.node.Node('probe').halt()\n",
    "from rclpy.qos import QoSProfiles  # noqa: TY001\n",
    "from rclpy.qos import QoSProfiles\n",
    "made = rclpy.create_node(7)\n",
    "made.halt(1)  # noqa: TY003\n",
    "<depend>rclpy</depend>\n",
    "\u00e4\n",
)


def edit(top: Path, random: Random) -> str:
    """Change something below a directory; return a description, to reproduce it."""
    change = random.choice(_EDITS)
    return f"{change.__name__.strip('_')} {change(top, random)}"


def _files(top: Path, endings: tuple[str, ...] = _TEXTS) -> list[Path]:
    return sorted(path for path in top.rglob("*") if path.is_file() and path.suffix in endings)


def _random_file(top: Path, random: Random) -> Path:
    """Return a random file, a Python file half of the time."""
    endings = (".py",) if random.random() < 0.5 else _TEXTS
    return random.choice(_files(top, endings) or _files(top))


def _lines(path: Path) -> list[str]:
    return path.read_text("utf-8", "surrogateescape").splitlines(keepends=True)


def _write(path: Path, lines: Sequence[str]) -> str:
    path.write_text("".join(lines), "utf-8", "surrogateescape")
    return str(path)


def _insert_line(top: Path, random: Random) -> str:
    path = _random_file(top, random)
    lines = _lines(path)
    lines.insert(random.randint(0, len(lines)), random.choice(_LINES))
    return _write(path, lines)


def _delete_line(top: Path, random: Random) -> str:
    path = _random_file(top, random)
    lines = _lines(path)
    if lines:
        lines.pop(random.randrange(len(lines)))
    return _write(path, lines)


def _repeat_line(top: Path, random: Random) -> str:
    path = _random_file(top, random)
    lines = _lines(path) or ["\n"]
    lines.insert(random.randrange(len(lines)), random.choice(lines))
    return _write(path, lines)


def _replace_word(top: Path, random: Random) -> str:
    """Replace a word of one file by a word of another, so that names start or stop to match."""
    path, other = _random_file(top, random), _random_file(top, random)
    words = re.split(r"(\w+)", "".join(_lines(path)))
    new = re.findall(r"\w+", "".join(_lines(other)))
    if len(words) > 1 and new:
        words[random.randrange(1, len(words), 2)] = random.choice(new)
    return _write(path, words)


def _misspell(top: Path, random: Random) -> str:
    path = _random_file(top, random)
    words = re.split(r"(\w{4,})", "".join(_lines(path)))
    if len(words) > 1:
        at = random.randrange(1, len(words), 2)
        words[at] = words[at][1:]
    return _write(path, words)


def _edit_two(top: Path, random: Random) -> str:
    return f"{_replace_word(top, random)} {_insert_line(top, random)}"


def _import_another(top: Path, random: Random) -> str:
    """Let a module import another one of its directory, so that it depends on its types."""
    path = random.choice(_files(top, (".py",)) or _files(top))
    others = [item for item in _files(top, (".py",)) if item.parent == path.parent]
    other = random.choice(others or [path])
    names = re.findall(r"^(?:class|def) (\w+)|^(\w+) =", "".join(_lines(other)), re.MULTILINE)
    name = "".join(random.choice(names)) if names else "made"
    lines = _lines(path)
    place = f"{path.parent.name}.{other.stem}" if random.random() < 0.7 else f".{other.stem}"
    lines.insert(random.randint(0, len(lines)), f"from {place} import {name}\n{name}().halt()\n")
    return _write(path, lines)


def _rename(top: Path, random: Random) -> str:
    path = _random_file(top, random)
    new = path.with_name(f"{path.stem}_{random.randrange(100)}{path.suffix}")
    path.rename(new)
    return f"{path} to {new.name}"


def _delete(top: Path, random: Random) -> str:
    path = _random_file(top, random)
    if path.name != "package.xml":
        path.unlink()
    return str(path)


def _copy(top: Path, random: Random) -> str:
    path = _random_file(top, random)
    other = random.choice(_files(top)).with_name(path.name)
    other.write_bytes(path.read_bytes())
    return f"{path} to {other}"


def _swap(top: Path, random: Random) -> str:
    item, other = _random_file(top, random), _random_file(top, random)
    first, second = item.read_bytes(), other.read_bytes()
    if item.suffix == other.suffix:
        item.write_bytes(second)
        other.write_bytes(first)
    return f"{item} with {other}"


def _touch(top: Path, random: Random) -> str:
    path = _random_file(top, random)
    at = random.randrange(10**9)
    os.utime(path, (at, at))
    return str(path)


def _change_mode(top: Path, random: Random) -> str:
    path = _random_file(top, random)
    path.chmod(path.stat().st_mode ^ 0o111)
    return str(path)


_EDITS: Sequence[Edit] = (
    *(_insert_line, _insert_line, _insert_line, _delete_line, _delete_line, _repeat_line),
    *(_replace_word, _replace_word, _replace_word, _misspell, _misspell, _edit_two),
    *(_import_another, _import_another),
    *(_rename, _delete, _copy, _swap, _touch, _change_mode),
)
