"""ND042: a rate sleeps only while another thread spins the node."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule, fact
from scaffold.api.programs import Waits, waits_alone, waits_in
from scaffold.api.rclpy import RclpyFile

_NODE = (
    "import threading\n\nimport rclpy\n\n\n"
    "def main():\n"
    "    rclpy.init()\n"
    "    node = rclpy.create_node('talker')\n"
    "{}"
    "    rate = node.create_rate(10)\n"
    "    while rclpy.ok():\n"
    "        rate.sleep()\n"
)
_THREAD = "    threading.Thread(target=rclpy.spin, args=(node,), daemon=True).start()\n"
_FILES = {
    "package.xml": "<package><name>demo</name>"
    "<export><build_type>ament_python</build_type></export></package>\n",
    "setup.py": "from setuptools import setup\n\nsetup(name='demo', packages=['demo'],\n"
    "      entry_points={'console_scripts': ['talker = demo.talker:main']})\n",
}
_ALONE = _NODE.format("").replace("import threading\n\n", "")


class RateNeverWakes(Rule):
    """``rate.sleep()`` waits for a timer that only the same thread could run.

    **Why.** A rate is woken by a timer of the node, and timers run only while the node is spun:
    without a second thread, the program hangs at the first ``sleep`` forever.

    **Fix.** Do the work of the loop in a timer, or spin the node in a separate thread.

    **Source.** ``rclpy/timer.py``, ``Rate.sleep``; rclpy issue 443.
    """

    code = "ND042"
    name = "rate-never-wakes"
    examples = (
        Example("spun in a thread", {**_FILES, "demo/talker.py": _NODE.format(_THREAD)}),
        Example(
            "never spun",
            {**_FILES, "demo/talker.py": _ALONE},
            Report(
                "demo/talker.py:9:9",
                "sleep() never returns: the thread that would wake it is blocked in this call",
            ),
        ),
        Example(
            "a thread that does not spin",
            {
                **_FILES,
                "demo/talker.py": _NODE.format(
                    "    threading.Thread(target=print, args=(node,)).start()\n"
                    "    process_group = [node]\n"
                ),
            },
            Report(
                "demo/talker.py:13:9",
                "sleep() never returns: the thread that would wake it is blocked in this call",
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for at, where in waits_alone(package, "sleep", _sleeps):
            yield self.report(at, f"sleep() never returns: the thread that would wake it {where}")


@fact
def _sleeps(package: Package, path: str, function: str | None) -> Waits:
    return waits_in(package, (path, function), "sleep", _is_sleep)


def _is_sleep(file: RclpyFile, call: ast.Call) -> bool:
    value = call.func.value if isinstance(call.func, ast.Attribute) else call.func
    match file.evaluator.single_value(value):
        case ast.Call(func=ast.Attribute(attr="create_rate", value=node)):
            return file.owner_of(node) is not None
    return False
