"""IM054: an event loop is created before it is requested."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Effect, Example, PythonRule
from scaffold.api.distributions import target
from scaffold.api.python import PythonModule, conditions_on, is_handled
from scaffold.api.rclpy import is_asked_for

_FIRST = (3, 14)
"""The first Python in which getting the current event loop does not create one."""
_NAME = "asyncio.get_event_loop"
_SETTER = "set_event_loop"
_MAKERS = ("nest_asyncio", "qasync", "uvloop")
"""Modules that set the current loop or the policy."""
_RUNNERS = ("asyncio.run", "run_until_complete", "run_forever", "create_task")
"""Functions that run a loop, in which nodes may be spun."""
_MAIN = (
    "import asyncio\n{}\n\nasync def work():\n    loop = asyncio.get_event_loop()\n"
    "    await loop.run_in_executor(None, print)\n\n\n"
    "def main():\n    loop = {}\n    loop.run_until_complete(work())\n"
)
_OLD = "asyncio.get_event_loop()"


class EventLoopMissing(PythonRule):
    """A program requests the current event loop of asyncio when there is none.

    Reported in ``main``, in a function that it calls, in the constructor or a timer of its node,
    and at the top of a module, if no loop is running and the file sets none.

    **Why.** Python 3.14, which Lyrical uses, does not create one: ``RuntimeError: There is no
    current event loop in thread 'MainThread'``.

    **Fix.** Run the coroutine with ``asyncio.run()``, or create the loop with
    ``asyncio.new_event_loop()`` and set it with ``asyncio.set_event_loop()``.

    **Source.** Python 3.14, "What's new", asyncio; ClusterLabs/crmsh issue 2032.
    """

    code = "IM054"
    name = "event-loop-missing"
    effect = Effect.STOPS_PROGRAM
    since = "0.2"
    examples = (
        Example("an older Python", {"talker.py": _MAIN.format("", _OLD)}),
        Example(
            "a new loop",
            {"talker.py": _MAIN.format("", "asyncio.new_event_loop()")},
            distro="lyrical",
        ),
        Example(
            "a loop that the file sets",
            {"talker.py": _MAIN.format("asyncio.set_event_loop(asyncio.new_event_loop())", _OLD)},
            distro="lyrical",
        ),
        Example(
            "a program that handles the error, and a function that a loop may call",
            {
                "talker.py": "import asyncio\nimport sys\n\n\ndef main():\n    try:\n"
                f"        loop = {_OLD}\n    except RuntimeError:\n"
                "        loop = asyncio.new_event_loop()\n"
                "    return loop\n\n\n"
                f"def later():\n    {_OLD}.stop()\n\n\n"
                f"if sys.version_info < (3, 14):\n    loop = {_OLD}\n"
            },
            distro="lyrical",
        ),
        Example(
            "functions that other code calls, that may not request a loop, or whose caller "
            "handles the error",
            {
                "talker.py": "import asyncio\n\n\n"
                f"def later():\n    return {_OLD}\n\n\n"
                f"def given(loop):\n    return loop or {_OLD}\n\n\n"
                f"def prepared():\n    return {_OLD}\n\n\n"
                f"def one_by_one():\n    yield {_OLD}\n\n\n"
                "async def work():\n    later()\n\n\n"
                "def main():\n    given(asyncio.new_event_loop())\n    one_by_one()\n"
                "    try:\n        prepared()\n    except RuntimeError:\n        return\n"
                "    asyncio.run(work())\n",
            },
            distro="lyrical",
        ),
        Example(
            "the default policy of asyncio, which sets no loop",
            {
                "talker.py": _MAIN.format(
                    "asyncio.set_event_loop_policy(asyncio.DefaultEventLoopPolicy())", _OLD
                ),
                "listener.py": _MAIN.format(
                    "import loops\n\nasyncio.set_event_loop_policy(loops.Policy())", _OLD
                ),
            },
            "talker.py:10:12: Python 3.14 creates no event loop here: RuntimeError; use "
            "asyncio.run(), or set one with asyncio.new_event_loop()",
            distro="lyrical",
        ),
        Example(
            "in a function that main calls",
            {
                "talker.py": f"import asyncio\n\n\ndef loop():\n    return {_OLD}\n\n\n"
                "def main():\n    loop().run_forever()\n",
            },
            "5:12: Python 3.14 creates no event loop here: RuntimeError; use asyncio.run(), or "
            "set one with asyncio.new_event_loop()",
            distro="lyrical",
        ),
        Example(
            "in the constructor and a timer of a node that main creates, and in other places",
            {
                "talker.py": "import asyncio\n\nimport rclpy\nfrom rclpy.node import Node\n\n\n"
                "class Talker(Node):\n    def __init__(self):\n"
                f"        super().__init__('talker')\n        self.loop = {_OLD}\n"
                "        self.create_timer(1.0, self.talk)\n\n"
                f"    def talk(self):\n        {_OLD}.stop()\n\n"
                f"    def listen(self):\n        {_OLD}.stop()\n\n\n"
                "class Later:\n    def __init__(self):\n"
                f"        self.loop = {_OLD}\n\n\n"
                "async def work():\n    Later()\n\n\n"
                "def main():\n    rclpy.init()\n    rclpy.spin(Talker())\n",
            },
            "10:21: Python 3.14 creates no event loop here: RuntimeError; use asyncio.run(), or "
            "set one with asyncio.new_event_loop()",
            "14:9: Python 3.14 creates no event loop here: RuntimeError; use asyncio.run(), or "
            "set one with asyncio.new_event_loop()",
            distro="lyrical",
        ),
        Example(
            "in main, and at module level",
            {
                "talker.py": _MAIN.format("", _OLD),
                "listener.py": "import asyncio\n\n"
                f"if __name__ == '__main__':\n    {_OLD}.close()\n",
            },
            "listener.py:4:5: Python 3.14 creates no event loop here: RuntimeError; use "
            "asyncio.run(), or set one with asyncio.new_event_loop()",
            "talker.py:10:12: Python 3.14 creates no event loop here: RuntimeError; use "
            "asyncio.run(), or set one with asyncio.new_event_loop()",
            distro="lyrical",
        ),
    )

    def check_file(self, module: PythonModule) -> Iterator[Diagnostic]:
        if target().python < _FIRST or not module.mentions("get_event_loop"):
            return
        if module.mentions(*_MAKERS) or _sets_loop(module):
            return
        for call in module.calls_of(_NAME):
            if not _is_at_start(module, call):
                continue
            if is_handled(module, call, "RuntimeError") or is_asked_for(module, call, _NAME):
                continue
            message = (
                f"Python {target().python_version} creates no event loop here: RuntimeError; use "
                f"asyncio.run(), or set one with asyncio.new_event_loop()"
            )
            yield self.report(module.location(call), message)


def _sets_loop(module: PythonModule) -> bool:
    """Return whether a file sets a loop, or a policy other than those of asyncio."""
    policies = [
        policy
        for call in module.calls_of("asyncio.set_event_loop_policy")
        for policy in call.args
        if isinstance(policy, ast.Call)
        and (module.qualified_name(policy.func) or "").startswith("asyncio.")
    ]
    return module.source.text.count(_SETTER) > len(policies)


def _is_at_start(module: PythonModule, call: ast.Call) -> bool:
    """Return whether a program runs a call before it has a loop, also in a function of main."""
    if _is_of_program(module, call):
        return True
    around = _functions_around(module, call)
    if len(around) != 1 or conditions_on(module, call):
        return False  # arguments may decide whether the function gets the loop
    name = _name_called(module, around[0])
    if not name or not _is_plain(around[0]) or len(module.index.bindings(module.tree)[name]) > 1:
        return False
    for use in module.index.names(name):
        site, lookup = module.call_with(use), module.index.lookup(use.id, use)
        if lookup is None or lookup[0] is not module.tree:
            continue
        if site is not None and _runs_into_it(module, site):
            return True
    return False


def _name_called(module: PythonModule, function: ast.AST) -> str:
    """Return the name in the file of a called function, or of the class that it constructs."""
    above = module.parent(function)
    if isinstance(above, ast.Module) and isinstance(function, ast.FunctionDef):
        return function.name
    if isinstance(above, ast.ClassDef) and isinstance(function, ast.FunctionDef):
        is_run = function.name == "__init__" or _is_of_timer(module, function.name)
        return above.name if is_run and above.name in module.classes else ""
    return ""


def _is_of_timer(module: PythonModule, method: str) -> bool:
    """Return whether a method is a timer callback without a surrounding asyncio loop."""
    return not module.mentions(*_RUNNERS) and any(
        isinstance(call.func, ast.Attribute)
        and call.func.attr == "create_timer"
        and any(module.text(argument) == f"self.{method}" for argument in call.args)
        for call in module.walk(ast.Call)
    )


def _functions_around(module: PythonModule, node: ast.AST) -> list[ast.AST]:
    kinds = (ast.Lambda, ast.GeneratorExp, ast.FunctionDef, ast.AsyncFunctionDef)
    return [parent for parent in module.parents(node) if isinstance(parent, kinds)]


def _is_plain(node: ast.AST) -> bool:
    """Return whether a call of a function runs its body immediately."""
    return (
        isinstance(node, ast.FunctionDef)
        and not node.decorator_list
        and not any(isinstance(part, ast.Yield | ast.YieldFrom) for part in ast.walk(node))
    )


def _runs_into_it(module: PythonModule, site: ast.Call) -> bool:
    """Return whether a call of a function that gets the loop is run without handling the error."""
    is_prepared = is_handled(module, site, "RuntimeError") or is_asked_for(module, site, _NAME)
    return _is_of_program(module, site) and not is_prepared


def _is_of_program(module: PythonModule, call: ast.Call) -> bool:
    """Return whether a call is run at module level, or by a ``main`` that is not awaited."""
    around = _functions_around(module, call)
    main = module.functions.get("main")
    if not around or main is None:
        return not around
    is_main = around == [main.node] and isinstance(main.node, ast.FunctionDef)
    return is_main and not any(
        isinstance(parent, ast.AsyncFunctionDef)
        for name in module.index.names("main")
        for parent in module.parents(name)
    )
