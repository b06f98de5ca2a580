"""ND070: methods and functions of the package get the arguments that they take."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, RclpyRule, Report
from scaffold.api.python import argument_error, is_handled
from scaffold.api.rclpy import RclpyFile, called_function

_NODE = (
    "from rclpy.node import Node\nfrom std_msgs.msg import String\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "        self.pub = self.create_publisher(String, 'chatter', 10)\n"
    "        self.talk({})\n\n"
    "    def talk(self, text, times=1):\n"
    "        for _ in range(times):\n"
    "            self.pub.publish(String(data=text))\n"
)


class OwnCallUnfit(RclpyRule):
    """A method of the node, or a function of the file, gets other arguments than it takes.

    **Why.** ``TypeError: Talker.talk() missing 1 required positional argument: 'text'`` when the
    line is reached; in a callback, it ends the node.

    **Fix.** Pass the arguments of the signature.

    **Source.** Python documentation, "Function definitions".
    """

    code = "ND070"
    name = "own-call-unfit"
    examples = (
        Example("the right arguments", {"talker.py": _NODE.format("'hello', times=2")}),
        Example(
            "a function of another module",
            {
                "package.xml": "<package><name>talker</name></package>\n",
                "talker/__init__.py": "",
                "talker/text.py": "def make(text, count):\n    return f'{text}: {count}'\n",
                "talker/node.py": "import rclpy\n\nfrom talker.text import make\n\n"
                "rclpy.init()\nprint(make('a', 1))\nprint(make('a'))\n",
            },
            Report("talker/node.py:7:7", "make() is missing 'count': TypeError"),
        ),
        Example(
            "a constructor",
            {"talker.py": _NODE.format("'a'") + "\n\nTALKER = Talker('talker')\n"},
            Report("16:10", "Talker() takes no arguments, but gets 1: TypeError"),
        ),
        Example(
            "no argument",
            {"talker.py": _NODE.format("")},
            Report("9:9", "talk() is missing 'text': TypeError"),
        ),
        Example(
            "too many arguments",
            {"talker.py": _NODE.format("'a', 2, 3")},
            Report("9:9", "talk() takes 2 arguments, but gets 3: TypeError"),
        ),
        Example(
            "an unknown keyword",
            {"talker.py": _NODE.format("txt='a'")},
            Report("9:9", "talk() has no argument 'txt': TypeError"),
        ),
        Example(
            "overridden in a subclass, or reassigned",
            {
                "talker.py": _NODE.format("")
                + "\n\nclass Loud(Talker):\n    def talk(self):\n        pass\n"
            },
        ),
    )

    def check_in(self, package: Package, file: RclpyFile) -> Iterator[Diagnostic]:
        for call in file.module.walk(ast.Call):
            called = called_function(package, file, call)
            problem = argument_error(call, called.takes, bound=called.bound) if called else ""
            if called and problem and not is_handled(file.module, call, "TypeError"):
                message = f"{called.name}() {problem}: TypeError"
                yield self.report(file.module.location(call), message)
