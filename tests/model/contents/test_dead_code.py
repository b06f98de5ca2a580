"""Code that Python never executes."""

from __future__ import annotations

import pytest

from scaffold.check.rules.examples import package_of
from scaffold.check.rules.rule import Example
from scaffold.model.contents.dead_code import is_dead

CLASS = """import os
import driver
from driver import Base


class Talker(Base):
    LOUD = False
    {}

    def say(self):
        if {}:
            print('here')
"""


def is_dead_at(text: str, others: dict[str, str] | None = None) -> bool:
    package = package_of(Example("", {"talker/talk.py": text, **(others or {})}))
    line = text[: text.index("'here'")].count("\n") + 1
    return is_dead(package, "talker/talk.py", line)


@pytest.mark.parametrize(
    ("dead", "text"),
    [
        (True, "def talk():\n    return\n    print('here')\n"),
        (True, "def talk():\n    raise OSError\n    if talk:\n        print('here')\n"),
        (False, "def talk():\n    if talk:\n        return\n    print('here')\n"),
        (False, "def talk():\n    return\n\n\ndef say():\n    print('here')\n"),
        (True, "if (x for x in y):\n    pass\nelse:\n    print('here')\n"),
        (False, "if any(x for x in y):\n    pass\nelse:\n    print('here')\n"),
    ],
)
def test_code_after_a_return(text: str, *, dead: bool) -> None:
    assert is_dead_at(text) == dead


@pytest.mark.parametrize(
    ("dead", "between"),
    [
        (True, ""),
        (True, "def say():\n    talk()\n"),
        (True, "LOUD = True\n"),
        (False, "talk()\n"),
        (False, "say = talk\n"),
        (False, "@talk\ndef say():\n    pass\n"),
        (False, "class Teller:\n    number = talk()\n"),
    ],
)
def test_function_that_is_defined_again(between: str, *, dead: bool) -> None:
    first = "def talk():\n    print('here')\n"
    assert is_dead_at(f"{first}{between}def talk():\n    pass\n") == dead
    assert not is_dead_at(f"{first}{between}def tell():\n    pass\n")


@pytest.mark.parametrize(
    ("dead", "body"),
    [
        (True, "    loud = False\n    if loud:\n        print('here')\n"),
        (True, "    loud = True\n    if loud:\n        return\n    else:\n        print('here')\n"),
        (False, "    loud = True\n    if loud:\n        print('here')\n"),
        (False, "    loud = False\n    loud |= ask()\n    if loud:\n        print('here')\n"),
        (False, "    for loud in (False, True):\n        if loud:\n            print('here')\n"),
        (False, "    if is_loud:\n        print('here')\n"),
    ],
)
def test_branch_of_a_local_constant(body: str, *, dead: bool) -> None:
    assert is_dead_at(f"def talk(is_loud=False):\n{body}") == dead


@pytest.mark.parametrize(
    ("dead", "condition", "other"),
    [
        (True, "self.LOUD", ""),
        (True, "Talker.LOUD", ""),
        (True, "self.LOUD is True", ""),
        (False, "not self.LOUD", ""),
        (False, "self.LOUDER", ""),
        (False, "Teller.LOUD", ""),
        (False, "self.LOUD", "from talker.talk import Talker\n\nTalker.LOUD = True\n"),
        (True, "self.LOUD", "from talker.talk import Talker\n\nTalker.LOUD = False\n"),
        (
            False,
            "self.LOUD",
            "from talker.talk import Talker\n\n\nclass A(Talker):\n    LOUD = 1\n",
        ),
        (True, "self.LOUD", "class A:\n    LOUD = 1\n"),
    ],
)
def test_branch_that_an_attribute_of_a_class_disables(
    condition: str, other: str, *, dead: bool
) -> None:
    assert is_dead_at(CLASS.format("", condition), {"talker/other.py": other}) == dead


@pytest.mark.parametrize(
    ("dead", "setting", "other"),
    [
        (True, "driver.DEBUG = False\n", ""),
        (True, "driver.DEBUG = False\n", "import driver\n\ndriver.DEBUG = False\n"),
        (False, "driver.DEBUG = False\n", "import driver\n\ndriver.DEBUG = debug\n"),
        (False, "driver.DEBUG = False\n", "def talk():\n    global DEBUG\n"),
        (False, "driver.DEBUG = os.sep\n", ""),
        (False, "", ""),
    ],
)
def test_branch_that_a_setting_of_a_module_disables(
    setting: str, other: str, *, dead: bool
) -> None:
    text = CLASS.format("", "driver.DEBUG") + f"\n\n{setting}"
    assert is_dead_at(text, {"driver.py": other}) == dead
