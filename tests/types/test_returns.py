"""Inserted heads that tell a type checker the results of functions."""

from __future__ import annotations

import re
from collections.abc import Collection

import pytest

from scaffold.types.rewriting.returns import results


def types(text: str, taken: Collection[str] = ()) -> list[str]:
    """Return the inserted annotations of functions, with the values that they represent.

    Args:
        text: A file.
        taken: The parameters whose arguments are known for the first function.
    """
    body = text.index(":\n") + 2
    result = results(text, {body: taken} if taken else {})
    lines = "\n".join(line for added in result.lines.values() for line in added)
    values = dict(re.findall(r"global (\w+); \1 = (.*)", lines))
    return [
        re.sub(r"_Ros2TypeOf\[(\w+)\[0\]\]", lambda match: values[match[1]], head[5:-1])
        for _, _, head in result.heads
    ]


@pytest.mark.parametrize(
    ("body", "type_"),
    [
        ("    return self.pose\n", "[(self.pose)]"),
        ("    '''Return it.'''\n    return self.pose  # the newest\n", "[(self.pose)]"),
        ("    '''\n    return it\n    '''\n    return self.pose\n", "[(self.pose)]"),
        ("    # return None\n    return Pose(self)\n", "[(Pose(self))]"),
        ("    if self.x:\n        return None\n    return 1\n", "[(1)]"),
        ("    if self.x:\n        return\n    return 1\n", "[(1)]"),
        ("    if self.x:\n        return A(1)\n    return A(2)\n", "[(A(1))] | [(A(2))]"),
        ("    return Pose(\n        x=1,\n    )\n", "[(Pose( x=1, ))]"),
        (
            "    for pose in self.poses:\n        yield pose\n",
            "_Ros2Generator[[(pose)], None, None]",
        ),
        ("    def on(x):\n        return x\n    return 1\n", "[(1)]"),
    ],
)
def test_returned_expressions(body: str, type_: str) -> None:
    assert types(f"class A:\n    def made(self, given):\n{_indented(body)}")[0] == type_


def _indented(body: str) -> str:
    return re.sub("^", "    ", body, flags=re.MULTILINE)


@pytest.mark.parametrize(
    "body",
    [
        "    pass\n",
        "    return None\n",
        "    return self\n",
        "    return [self]\n",
        "    return lambda: 1\n",
        "    if self.x: return 1\n    return 2\n",
        "    given = yield self.x\n",
        "    yield from self.poses\n",
        "    yield 1\n    return 2\n",
        "    return [\n        1,  # one\n    ]\n",
        "    if self.x:\n        return A(1)\n    return B(2)\n",
        "    return A(1) if self.x else B(2)\n",
        "    self.x = A(1)\n    self.x = B(1)\n    return self.x\n",
        "    x = A(1)\n    if self.y:\n        x = B(1)\n    return x.y\n",
    ],
)
def test_functions_without_known_result(body: str) -> None:
    assert types(f"class A:\n    def made(self, given):\n{_indented(body)}") == []


@pytest.mark.parametrize(
    ("others", "is_known"),
    [
        ("", True),
        ("        self.all['x'] = B()\n", False),
        ("        self.all = {'x': B()}\n", False),
    ],
)
def test_elements_under_the_key_of_a_parameter(others: str, is_known: bool) -> None:
    text = (
        "class A:\n    def made(self, key):\n        self.all = {}\n"
        f"        self.all[key] = A(key)\n{others}        return self.all[key]\n"
    )
    assert bool(types(text, {"key"})) is is_known


@pytest.mark.parametrize(
    ("value", "is_known"),
    [
        ("given", False),
        ("given.x", False),
        ("[given]", False),
        ("list(given)", False),
        ("given.copy()", False),
        ("local", False),
        ("looped", False),
        ("Pose(given)", True),
        ("other", True),
    ],
)
def test_parameters_of_other_calls_are_unknown(value: str, is_known: bool) -> None:
    text = (
        "def made(given):\n    local = given[0]\n    other = Pose(given)\n"
        f"    for looped in given:\n        local.add(looped)\n    return {value}\n"
    )
    assert bool(types(text, {"given"})) is is_known
    assert types(text) == [f"[({value})]"]


@pytest.mark.parametrize(
    ("text", "count"),
    [
        ("class A:\n    @property\n    def made(self):\n        return 1\n", 1),
        ("@contextlib.contextmanager\ndef made():\n    yield 1\n", 1),
        ("@cached\ndef made():\n    return 1\n", 0),
        ("def made() -> Other:\n    return 1\n", 0),
        ("async def made():\n    yield 1\n", 0),
        (
            "class A:\n    @property\n    def made(self):\n        return 1\n\n{}".format(
                "    @made.setter\n    def made(self, value):\n        self.x = value\n"
            ),
            1,
        ),
        (
            "class A:\n    def made(self):\n        return 1\n\n\n{}".format(
                "class B(A):\n    def made(self):\n        return ''\n"
            ),
            0,
        ),
        ("def made(): return 1\n", 0),
    ],
)
def test_functions_with_inserted_heads(text: str, count: int) -> None:
    assert len(results(text, {}).heads) == count
