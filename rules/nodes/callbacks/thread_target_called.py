"""ND064: threads get functions and are started, timers have a period, coroutines are awaited."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator, Mapping, Sequence

from scaffold.api import Diagnostic, Example, Package, RclpyRule, Report, Severity
from scaffold.api.python import is_guarded_by, last_name
from scaffold.api.rclpy import RclpyFile, Timer, is_used_elsewhere, numbers_taken

_SPINS = frozenset({"rclpy.spin", "rclpy.spin_once", "rclpy.spin_until_future_complete"})
_NODE = (
    "import threading\n\nfrom rclpy.node import Node\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "        threading.Thread(target=self.work{}).start()\n"
    "        self.create_timer({}, self.tick)\n\n"
    "    def work(self):\n        pass\n\n"
    "    async def ask(self):\n        pass\n\n"
    "    async def tick(self):\n        {}self.ask()\n"
)
_MAIN = "\n\ndef main():\n    rclpy.init()\n    rclpy.spin(Talker())\n"


class ThreadTargetCalled(RclpyRule):
    """A thread target is called instead of passed, or a thread or coroutine never runs.

    **Why.** ``Thread(target=self.work())`` calls the function immediately, in the current thread,
    and the new thread does nothing. A thread that is not started and a coroutine that is not
    awaited never run. A a timer with period 0 uses all CPU time; use a longer period.

    **Fix.** Write ``target=self.work``, ``thread.start()``, ``await self.ask()``, and a period
    greater than 0.

    **Source.** Python documentation, ``threading.Thread``, "Coroutines"; rclpy, ``timer.py``.
    """

    code = "ND064"
    name = "thread-target-called"
    other_severities = {Severity.WARNING: "a thread that never ends"}
    examples = (
        Example(
            "as many arguments as the target takes, and others",
            {
                "reader.py": "from threading import Thread\n\nfrom rclpy.node import Node\n\n\n"
                "class Reader(Node):\n"
                "    def start(self):\n"
                "        Thread(target=self.read, args=('a',)).start()\n"
                "        Thread(target=self.read, args=('a', 2)).start()\n"
                "        Thread(target=self.read, args=('a', 2, 3)).start()\n"
                "        Thread(target=self.read).start()\n\n"
                "    def read(self, port, rate=1):\n        return port, rate\n"
            },
            "10:23: read() takes 1 to 2 arguments, but the thread passes 3: TypeError in the "
            "thread",
            "11:23: read() takes 1 to 2 arguments, but the thread passes 0: TypeError in the "
            "thread",
        ),
        Example("passed, awaited", {"talker.py": _NODE.format("", "0.1", "await ")}),
        Example(
            "a parameter that may be set",
            {
                "talker.py": _NODE.format(
                    "", "self.declare_parameter('period', 0.0).value", "await "
                )
            },
        ),
        Example(
            "created only with a period",
            {
                "talker.py": _NODE.format("", "self.lag", "await ")
                .replace("        self.create", "        self.lag = 0.0\n        self.create")
                .replace("        self.create", "        if self.lag:\n            self.create")
            },
        ),
        Example(
            "a timer that fires once",
            {
                "talker.py": _NODE.format("", "0.0", "self.once.cancel()\n        await ").replace(
                    "        self.create_timer", "        self.once = self.create_timer"
                )
            },
        ),
        Example(
            "called, zero, not awaited",
            {"talker.py": _NODE.format("()", "0.0", "")},
            "9:33: work() is called here, not in the thread; pass the function itself",
            "10:27: a timer with period 0 uses all CPU time; use a longer period",
            "19:9: coroutine ask() is not awaited: it never runs",
        ),
        Example(
            "a coroutine as a condition",
            {
                "talker.py": _NODE.format("", "0.1", "await ").replace(
                    "await self.ask()\n",
                    "if not self.ask():\n            return\n        task = self.ask()\n"
                    "        await task\n",
                )
            },
            "19:16: coroutine ask() is not awaited: it is always true",
        ),
        Example(
            "stored, and awaited later",
            {
                "talker.py": "import rclpy\n"
                + _NODE.format("", "0.1", "self.asked = ")
                + "\n    async def wait(self):\n        await self.asked\n"
                + _MAIN
            },
        ),
        Example(
            "stored, and never used",
            {"talker.py": "import rclpy\n" + _NODE.format("", "0.1", "self.asked = ") + _MAIN},
            "20:22: coroutine ask() is not awaited: it never runs",
        ),
        Example(
            "an argument in parentheses",
            {"talker.py": _NODE.format(", args=(self)", "0.1", "await ")},
            "9:50: (self) is not a tuple: TypeError in the thread; write (self,)",
        ),
        Example(
            "never started, and started elsewhere",
            {
                "talker.py": _NODE.format("", "0.1", "await ") + "\n    def more(self):\n"
                "        first = threading.Thread(target=self.work)\n"
                "        first.daemon = True\n"
                "        second = threading.Thread(target=self.work)\n"
                "        return second\n"
            },
            "22:17: this thread is never started: its target never runs; call start()",
        ),
        Example(
            "spin called immediately",
            {
                "talker.py": "import rclpy\n"
                + _NODE.format("", "0.1", "await ").replace("self.work)", "rclpy.spin(self))")
            },
            "10:33: rclpy.spin() is called here, not in the thread; write target=rclpy.spin, "
            "args=(node,)",
        ),
        Example(
            "an endless thread, a daemon thread, and a number instead of a tuple",
            {
                "reader.py": "from threading import Thread\nimport time\n\n"
                "from rclpy.node import Node\n\n\n"
                "class Reader(Node):\n"
                "    def __init__(self):\n"
                "        super().__init__('reader')\n"
                "        period = 0.1\n"
                "        Thread(target=self.read).start()\n"
                "        Thread(target=self.wait, args=(period)).start()\n\n"
                "    def wait(self, period):\n"
                "        time.sleep(period)\n\n"
                "    def read(self):\n"
                "        while True:\n"
                "            self.value = time.monotonic()\n"
                "            time.sleep(0.1)\n"
            },
            Report(
                "11:9",
                "this thread never ends: the program does not exit on Ctrl-C; write daemon=True",
                severity=Severity.WARNING,
            ),
            "12:40: (period) is not a tuple: TypeError in the thread; write (period,)",
        ),
        Example(
            "executor spun in a thread, and before it",
            {
                f"{name}.py": "import threading\n\nimport rclpy\n"
                "from rclpy.executors import SingleThreadedExecutor\n\n\n"
                "def main():\n"
                "    rclpy.init()\n"
                "    executor = SingleThreadedExecutor()\n"
                "    executor.add_node(rclpy.create_node('talker'))\n"
                f"    thread = threading.Thread(target=executor.spin{call}, daemon=True)\n"
                "    thread.start()\n"
                for name, call in (("right", ""), ("wrong", "()"))
            },
            "wrong.py:11:38: executor.spin() is called here, not in the thread; write "
            "executor.spin",
        ),
        Example(
            "coroutine that replaces a method of the base class",
            {
                "package.xml": "<package><name>parts</name></package>\n",
                "parts/__init__.py": "",
                "parts/base.py": "from rclpy.node import Node\n\n\n"
                "class Part(Node):\n"
                "    def __init__(self):\n"
                "        super().__init__('part')\n"
                "        self.create_timer(1.0, self.guarded)\n\n"
                "    def guarded(self):\n"
                "        self.step()\n\n"
                "    def step(self):\n"
                "        pass\n",
                "parts/scale.py": "from parts.base import Part\n\n\n"
                "class Scale(Part):\n"
                "    async def step(self):\n"
                "        self.get_logger().info('weighs')\n\n\n"
                "class Pump(Part):\n"
                "    def step(self):\n"
                "        self.get_logger().info('pumps')\n",
            },
            "parts/scale.py:5:15: Part calls step() without await: the coroutine never runs",
        ),
    )

    def check_in(self, package: Package, file: RclpyFile) -> Iterator[Diagnostic]:
        for call in file.module.calls_of("threading.Thread"):
            if _is_left(package, file, call, _IDLE):
                message = "this thread is never started: its target never runs; call start()"
                yield self.report(file.module.location(call), message)
            for node, problem in _problems(file, call):
                yield self.report(file.module.location(node), problem)
            if _is_endless(file, call):
                message = (
                    "this thread never ends: the program does not exit on Ctrl-C; write daemon=True"
                )
                yield self.report(file.module.location(call), message, severity=Severity.WARNING)
        for node, problem in _unawaited(package, file):
            yield self.report(file.module.location(node), problem)
        for method, problem in _overrides_unawaited(file):
            yield self.report(file.module.name_location(method), problem)
        for timer in file.timers:
            argument = timer.argument("timer_period_sec")
            value, notes = file.evaluator.trace(argument.node if argument else None)
            # Zero as the default of a parameter is usually overridden.
            if argument is None or value not in (0, 0.0) or notes:
                continue
            is_guarded = is_guarded_by(file.module, timer.call, argument.node)
            if not is_guarded and not _is_ended(file, timer):
                yield self.report(
                    argument, "a timer with period 0 uses all CPU time; use a longer period"
                )


def _is_ended(file: RclpyFile, timer: Timer) -> bool:
    """Return whether a timer is canceled or destroyed anywhere, as in its first call."""
    index = file.module.index
    name = timer.attribute or timer.variable
    ends = [end.value for end in index.attributes("cancel")]
    calls = map(file.module.parent, index.attributes("destroy_timer"))
    ends += [call.args[0] for call in calls if isinstance(call, ast.Call) and call.args]
    return any(last_name(end) == name for end in ends)


def _is_single(file: RclpyFile, node: ast.expr) -> bool:
    """Return whether the arguments of a thread are certainly a single object, not a tuple."""
    if isinstance(node, ast.Constant):
        return not isinstance(node.value, str) or len(node.value) != 1
    if type(file.evaluator.evaluate(node)) in {int, float, bool}:
        return True
    return isinstance(node, ast.Name | ast.Attribute) and file.owner_of(node) is not None


def _is_left(package: Package, file: RclpyFile, call: ast.Call, idle: frozenset[str]) -> bool:
    """Return whether an object is never used, or never started."""
    index = file.module.index
    match file.module.parent(call):
        case ast.Assign(targets=[ast.Name() as name]):
            scope, uses = index.lookup(name.id, name), index.uses_of(name)
            is_own = scope is not None and not isinstance(scope[0], ast.Module | ast.ClassDef)
            return is_own and _are_idle(file, uses, idle)
        case ast.Assign(targets=[ast.Attribute(value=ast.Name(id="self"), attr=attribute)]):
            uses_of = index.attributes(attribute)
            is_idle = bool(file.init_calls) and _are_idle(file, uses_of, idle)
            return is_idle and not is_used_elsewhere(package, file, attribute)
        case parent:
            return isinstance(parent, ast.Expr)


def _are_idle(
    file: RclpyFile, uses: Sequence[ast.Name | ast.Attribute], idle: frozenset[str]
) -> bool:
    """Return whether no use of an object starts it or passes it on."""
    reads = [file.module.parent(use) for use in uses if isinstance(use.ctx, ast.Load)]
    return all(isinstance(use, ast.Attribute) and use.attr in idle for use in reads)


_IDLE = frozenset({"daemon", "name", "join", "is_alive"})
"""Attributes that do not start a thread."""
_ENDING = re.compile(
    r"\b(?:publish|rclpy|call|call_async|get_clock|get_parameter|sendTransform|rate|exit|_exit"
    r"|raise|break|return|yield|spin\w*|is_set|recv|accept|get)\b"
)
"""Matches code that leaves a loop, or fails once rclpy is shut down or a peer closes."""


def _is_endless(file: RclpyFile, thread: ast.Call) -> bool:
    """Return whether a non-daemon thread runs an endless loop."""
    words = {word.arg: word.value for word in thread.keywords}
    if (
        "target" not in words
        or "daemon" in words
        or file.module.mentions("daemon", "_exit", "kill")
    ):
        return False
    function = file.callback(words["target"]).function
    last = function.body[-1] if isinstance(function, ast.FunctionDef) else None
    is_loop = isinstance(last, ast.While) and isinstance(last.test, ast.Constant)
    reached = file.reached(function) if function is not None and is_loop else ()
    return is_loop and not any(_ENDING.search(file.module.text(item)) for item in reached)


def _problems(file: RclpyFile, thread: ast.Call) -> Iterator[tuple[ast.AST, str]]:
    for word in thread.keywords:
        if word.arg == "target" and isinstance(word.value, ast.Call):
            callback = file.callback(word.value)
            if callback.is_called and not callback.is_partial:
                message = (
                    f"{callback.name}() is called here, not in the thread; pass the function itself"
                )
                yield word.value, message
            elif any(spin.call is word.value for spin in file.spin_calls) and (
                isinstance(word.value.func, ast.Attribute)
                and file.module.qualified_name(word.value.func) not in _SPINS
            ):
                text = file.module.text(word.value.func)
                yield word.value, f"{text}() is called here, not in the thread; write {text}"
            elif file.module.qualified_name(word.value.func) in _SPINS:
                message = (
                    "rclpy.spin() is called here, not in the thread; write "
                    "target=rclpy.spin, args=(node,)"
                )
                yield word.value, message
        elif word.arg == "args" and _is_single(file, word.value):
            text = file.module.text(word.value)
            message = f"({text}) is not a tuple: TypeError in the thread; write ({text},)"
            yield word.value, message
    yield from _miscounted(file, {word.arg: word.value for word in thread.keywords})


def _miscounted(
    file: RclpyFile, words: Mapping[str | None, ast.expr]
) -> Iterator[tuple[ast.AST, str]]:
    """Yield a target that does not take as many arguments as the thread passes."""
    target, given = words.get("target"), words.get("args", ast.Tuple(elts=[], ctx=ast.Load()))
    if target is None or not words.keys() <= {"target", "args", "daemon", "name"}:
        return
    if not isinstance(given, ast.Tuple | ast.List) or isinstance(target, ast.Call):
        return
    callback, count = file.callback(target), len(given.elts)
    takes = numbers_taken(callback)
    if takes and count not in takes and not any(isinstance(x, ast.Starred) for x in given.elts):
        most = "" if len(takes) == 1 else f" to {takes[-1]}"
        message = f"{callback.name}() takes {takes[0]}{most} arguments, but the thread passes "
        yield target, f"{message}{count}: TypeError in the thread"


def _unawaited(package: Package, file: RclpyFile) -> Iterator[tuple[ast.AST, str]]:
    """Yield the coroutines that are created but never run."""
    for call in file.module.walk(ast.Call):
        effect = _effect_unawaited(file, call)
        is_kept = isinstance(file.module.parent(call), ast.Assign)
        function = file.callback(call.func).function if effect or is_kept else None
        if not isinstance(function, ast.AsyncFunctionDef) or function.decorator_list:
            continue
        if is_kept and not any(file.module.below(function, ast.Yield)):
            effect = "it never runs" if _is_left(package, file, call, frozenset()) else ""
        if effect:
            yield call, f"coroutine {function.name}() is not awaited: {effect}"


def _overrides_unawaited(file: RclpyFile) -> Iterator[tuple[ast.AsyncFunctionDef, str]]:
    """Yield coroutines that replace a method which a base class calls without awaiting it."""
    for node in file.classes:
        for name, method in node.methods.items():
            base = node.base
            while base is not None and name not in base.methods:
                base = base.base
            if base is None or not isinstance(method, ast.AsyncFunctionDef):
                continue
            if method.decorator_list or not isinstance(base.methods[name], ast.FunctionDef):
                continue
            module = base.file.module
            calls = [module.parent(use) for use in module.index.attributes(name)]
            called = [call for call in calls if isinstance(call, ast.Call)]
            plain = [call for call in called if isinstance(module.parent(call), ast.Expr)]
            if called and called == plain and len(called) == len(calls):
                message = f"{base.name} calls {name}() without await: the coroutine never runs"
                yield method, message


def _effect_unawaited(file: RclpyFile, call: ast.Call) -> str:
    """Return the effect of an unawaited coroutine; empty if it may be run later."""
    match file.module.parent(call):
        case ast.Expr():
            return "it never runs"
        case ast.UnaryOp(op=ast.Not()) | ast.If() | ast.While() | ast.IfExp() as above if (
            getattr(above, "test", call) is call
        ):
            return "it is always true"
    return ""
