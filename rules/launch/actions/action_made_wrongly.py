"""LF047: actions have their required arguments, and lists of actions contain actions."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from difflib import get_close_matches

from scaffold.api import Diagnostic, Example, LaunchRule
from scaffold.api.launch import NODES, LaunchCall, LaunchFile, describe, entities

_ACTIONS = frozenset(
    {*NODES, "DeclareLaunchArgument", "ExecuteProcess", "GroupAction", "IncludeLaunchDescription"}
    | {"LogInfo", "OpaqueFunction", "RegisterEventHandler", "TimerAction"}
)
_SETTERS = ("PushRosNamespace", "PushROSNamespace", "SetParameter", "SetRemap")
_RUNNING = frozenset({*NODES, "IncludeLaunchDescription"})
_LAUNCH = (
    "from launch import LaunchDescription\nfrom launch.actions import GroupAction\n"
    "from launch_ros.actions import Node\n\n\n"
    "def generate_launch_description():\n"
    "    node = Node(package='talker', {})\n"
    "    return LaunchDescription({})\n"
)
_RIGHT = ("executable='node'", "[GroupAction([node])]")


def _launch(node: str, actions: str) -> dict[str, str]:
    return {"launch/a.launch.py": _LAUNCH.format(node, actions)}


_LAUNCH_ITEMS = (
    "from launch import LaunchDescription\nfrom launch.actions import RegisterEventHandler\n"
    "from launch.event_handlers import OnProcessExit\n"
    "from launch.substitutions import LaunchConfiguration\nfrom launch_ros.actions import Node\n"
    "\n\ndef generate_launch_description():\n"
    "    name = LaunchConfiguration('name', default='a')\n"
    "    node = Node(package='talker', executable='node', name=name)\n"
    "    handler = OnProcessExit(target_action=node, on_exit=[])\n"
    "    return LaunchDescription([{}])\n"
)
_ALONE = frozenset({"this is a list", "this is a tuple", "this is a function", "this is None"})
"""Types that a handler accepts instead of a list."""
_STATES = (
    *("unconfigured", "inactive", "active", "finalized", "configuring", "activating"),
    *("deactivating", "cleaningup", "shuttingdown", "errorprocessing"),
)
"""The labels of lifecycle states, also of those during transitions."""


class ActionMadeWrongly(LaunchRule):
    """An action lacks its executable, or a list of actions is not a list or has other items.

    **Why.** ``ros2 launch`` stops: ``TypeError: 'Node' object is not iterable`` without the list,
    ``'list' object has no attribute 'describe_sub_entities'`` (or ``'LaunchConfiguration'``,
    ``'NoneType'``), ``'Node' object is not callable`` if a comma is missing between two actions,
    ``missing 1 required keyword-only argument: 'executable'``. A setting at the end of a group has
    no effect.

    **Fix.** Write ``Node(package=..., executable=...)`` and ``actions=[...]``, with settings first.
    Unpack lists with ``*nodes``, wrap handlers in ``RegisterEventHandler(...)`` and sources in
    ``IncludeLaunchDescription(...)``. Use substitutions only as arguments.

    **Source.** ``launch/actions/group_action.py``, ``timer_action.py``;
    ``launch/launch_description_entity.py``; ``launch/utilities``; ``launch_ros/actions/node.py``.
    """

    code = "LF047"
    name = "action-made-wrongly"
    examples = (
        Example("valid actions", _launch(*_RIGHT)),
        Example(
            "an action instead of a list",
            _launch(_RIGHT[0], "[GroupAction(node)]"),
            "8:43: expected a list of actions, not a single Node",
        ),
        Example(
            "several arguments",
            _launch(_RIGHT[0], "node, node"),
            "8:12: LaunchDescription takes one list of actions; put them in [...]",
        ),
        Example(
            "a missing comma",
            _launch(_RIGHT[0], "[Node(package='a', executable='b')(node)]"),
            "8:31: missing comma after Node: TypeError",
        ),
        Example(
            "no executable",
            _launch("name='node'", "[node]"),
            "7:12: Node needs executable=...: TypeError",
        ),
        Example(
            "no package; a setting at the end",
            {
                "launch/a.launch.py": _LAUNCH.format("executable='node.py'", "[node]").replace(
                    "package='talker', ", ""
                ),
                "launch/b.launch.py": _LAUNCH.format(
                    "executable='node'", "[GroupAction([node, SetParameter('a', 1)])]"
                ).replace("import Node", "import Node, SetParameter"),
            },
            "launch/a.launch.py:7:12: Node has no package=...: launch searches for the executable "
            "on PATH",
            "launch/b.launch.py:8:50: SetParameter at the end of the group has no effect; move it "
            "before the actions it is for",
        ),
        Example(
            "settings before and after the nodes",
            {
                "launch/a.launch.py": _LAUNCH.replace(
                    "import Node", "import Node, SetParameter"
                ).format(
                    "executable='a'", "[GroupAction([]), SetParameter('use_sim_time', True), node]"
                ),
                "launch/b.launch.py": _LAUNCH.replace(
                    "import Node", "import Node, SetParameter"
                ).format(
                    "executable='a'", "[GroupAction([]), node, SetParameter('use_sim_time', True)]"
                ),
            },
            "launch/b.launch.py:8:54: SetParameter at the end of the list has no effect; move it "
            "before the actions it is for",
        ),
        Example(
            "a list of actions",
            {"launch/a.launch.py": _LAUNCH_ITEMS.format("*[node], RegisterEventHandler(handler)")},
        ),
        Example(
            "a nested list, a substitution and a handler in the list",
            {"launch/a.launch.py": _LAUNCH_ITEMS.format("[node],\n name,\n handler")},
            "12:31: this is a list, but LaunchDescription takes actions; unpack it with *",
            "13:2: this is a LaunchConfiguration, but LaunchDescription takes actions",
            "14:2: this is the handler OnProcessExit, but LaunchDescription takes actions; wrap "
            "it in RegisterEventHandler(...)",
        ),
        Example(
            "a string, a class and None in the list",
            {"launch/a.launch.py": _LAUNCH_ITEMS.format("'node',\n Node,\n None")},
            "12:31: this is a string, but LaunchDescription takes actions",
            "13:2: this is a class, but LaunchDescription takes actions; call it",
            "14:2: this is None, but LaunchDescription takes actions",
        ),
        Example(
            "a tuple and a function in the list",
            {
                "launch/a.launch.py": _LAUNCH_ITEMS.format("(node, node),\n talk")
                + "\n\ndef talk():\n    return []\n"
            },
            "12:31: this is a tuple, but LaunchDescription takes actions; unpack it with *",
            "13:2: this is a function, but LaunchDescription takes actions; call it",
        ),
        Example(
            "an event in on_exit of a node",
            {
                "launch/a.launch.py": "from launch.events import Shutdown\n"
                + _LAUNCH_ITEMS.format("node").replace("name=name", "on_exit=Shutdown()")
            },
            "11:62: this is an event, but 'on_exit' of Node takes actions; wrap it in "
            "EmitEvent(event=...)",
        ),
        Example(
            "an event, a source, and a node in a container",
            {
                "launch/a.launch.py": "from launch.events import Shutdown\n"
                "from launch.launch_description_sources import AnyLaunchDescriptionSource\n"
                "from launch_ros.actions import ComposableNodeContainer\n"
                + _LAUNCH_ITEMS.format(
                    "Shutdown(),\n AnyLaunchDescriptionSource('a'),\n"
                    " ComposableNodeContainer(name='a', "
                    "namespace='', package='b', executable='c',\n"
                    "  composable_node_descriptions=[node])"
                )
            },
            "15:31: this is an event, but LaunchDescription takes actions; wrap it in "
            "EmitEvent(event=...)",
            "16:2: this is an AnyLaunchDescriptionSource, but LaunchDescription takes actions; "
            "wrap it in IncludeLaunchDescription(...)",
            "18:33: expected a ComposableNode in a container, not a Node",
        ),
        Example(
            "state of a lifecycle node",
            {
                "launch/probe.launch.py": "from launch import LaunchDescription\n"
                "from launch.actions import LogInfo, RegisterEventHandler\n"
                "from launch_ros.event_handlers import OnStateTransition\n\n\n"
                "def generate_launch_description():\n"
                "    return LaunchDescription([\n"
                "        RegisterEventHandler(OnStateTransition(\n"
                "            goal_state='inactive', entities=[LogInfo(msg='a')])),\n"
                "        RegisterEventHandler(OnStateTransition(\n"
                "            goal_state='configured', entities=[LogInfo(msg='b')])),\n"
                "    ])\n"
            },
            "11:24: no lifecycle state is called 'configured': this never happens; did you mean "
            "'unconfigured'?",
        ),
    )

    def check_file(self, launch: LaunchFile) -> Iterator[Diagnostic]:
        yield from self._check_arguments(launch)
        yield from self._check_items(launch)
        yield from self._check_states(launch)

    def _check_arguments(self, launch: LaunchFile) -> Iterator[Diagnostic]:
        for call in launch.calls:
            problem = _problem(launch, call)
            if problem:
                yield self.report(call, problem)
            if call.kind in _ACTIONS:
                yield from self._check_action(launch, call)
            above = launch.module.parent(call.call)
            if call.kind == "LaunchDescription" and isinstance(above, ast.Return):
                last = _setting_nothing(launch, call.given.get("initial_entities"))
                if last is not None:
                    message = (
                        f"{last.kind} at the end of the list has no effect; move it before "
                        f"the actions it is for"
                    )
                    yield self.report(last, message)

    def _check_states(self, launch: LaunchFile) -> Iterator[Diagnostic]:
        for call in launch.find("OnStateTransition"):
            for word in ("start_state", "goal_state"):
                state = launch.text(call, word)
                if isinstance(state, str) and state not in _STATES:
                    closest = get_close_matches(state, _STATES, 1, 0.6)
                    hint = f"; did you mean {closest[0]!r}?" if closest else ""
                    message = f"no lifecycle state is called {state!r}: this never happens{hint}"
                    yield self.report(launch.location(call.given[word]), message)

    def _check_action(self, launch: LaunchFile, call: LaunchCall) -> Iterator[Diagnostic]:
        parent = launch.module.parent(call.call)
        if isinstance(parent, ast.Call) and parent.func is call.call:
            yield self.report(call, f"missing comma after {call.kind}: TypeError")
        if call.kind in {"GroupAction", "TimerAction"}:
            name = "GroupAction" if call.call.args and call.kind == "GroupAction" else ""
            actions = call.call.args[0] if name else call.given.get("actions")
            view = launch.call_of(actions)
            if actions is not None and view is not None and view.kind in _ACTIONS:
                yield self.report(
                    launch.location(actions),
                    f"expected a list of actions, not a single {view.kind}",
                )
            if call.kind == "GroupAction" and "scoped" not in call.given:
                last = _setting_nothing(launch, actions)
                if last is not None:
                    message = (
                        f"{last.kind} at the end of the group has no effect; move it before "
                        f"the actions it is for"
                    )
                    yield self.report(last, message)

    def _check_items(self, launch: LaunchFile) -> Iterator[Diagnostic]:
        for item in entities(launch):
            description = describe(launch, item.node)
            if description and not (item.is_alone and description in _ALONE):
                message = (
                    f"{description}, but {item.taker} takes actions{_replacement(description)}"
                )
                yield self.report(launch.location(item.node), message)
        for call in launch.calls:
            listed = call.given.get("composable_node_descriptions")
            for node in listed.elts if isinstance(listed, ast.List) else ():
                view = launch.call_of(node)
                if view is not None and view.kind in NODES:
                    message = f"expected a ComposableNode in a container, not a {view.kind}"
                    yield self.report(launch.location(node), message)


def _setting_nothing(launch: LaunchFile, actions: ast.expr | None) -> LaunchCall | None:
    """Return the last action of a group if it only affects later actions."""
    if not isinstance(actions, ast.List) or len(actions.elts) < 2:  # noqa: PLR2004  one before it
        return None
    *before, last = [launch.call_of(item) for item in actions.elts]
    runs = any(item is not None and item.kind in _RUNNING for item in before)
    return last if runs and last is not None and last.kind in _SETTERS else None


def _problem(launch: LaunchFile, call: LaunchCall) -> str:
    if call.kind in NODES and not call.is_open and not call.call.args:
        if "executable" not in call.given and "node_executable" not in call.given:
            return f"{call.kind} needs executable=...: TypeError"
        if "package" not in call.given and _is_script(launch, call):
            return f"{call.kind} has no package=...: launch searches for the executable on PATH"
    second = call.call.args[1] if len(call.call.args) > 1 else None
    if call.kind == "LaunchDescription" and launch.call_of(second) is not None:
        return "LaunchDescription takes one list of actions; put them in [...]"
    return ""


def _is_script(launch: LaunchFile, call: LaunchCall) -> bool:
    """Return whether the program is certainly not on ``PATH``."""
    name = launch.text(call, "executable")
    return isinstance(name, str) and name.endswith(".py") and "/" not in name


def _replacement(kind: str) -> str:
    """Return what to write instead."""
    if kind in {"this is a list", "this is a tuple"}:
        return "; unpack it with *"
    if kind == "this is an event":
        return "; wrap it in EmitEvent(event=...)"
    if "handler" in kind:
        return "; wrap it in RegisterEventHandler(...)"
    if "Source" in kind:
        return "; wrap it in IncludeLaunchDescription(...)"
    if "class" in kind or "function" in kind:
        return "; call it"
    return ""
