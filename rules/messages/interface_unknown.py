"""MS001: imported interfaces exist."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, MessageRule, Report
from scaffold.api.distributions import removed_interface
from scaffold.api.interfaces import KINDS, Definitions, closest_word
from scaffold.api.messages import MessageTypes, interfaces_named

_MISSPELLED = {"msgs": "msg", "message": "msg", "messages": "msg", "mgs": "msg", "srvs": "srv"}
_MISSPELLED |= {
    "service": "srv",
    "services": "srv",
    "sev": "srv",
    "svr": "srv",
    "actions": "action",
}


class InterfaceUnknown(MessageRule):
    """Python code imports a message, service or action that its package does not define.

    **Why.** The node ends at start: ``ImportError: cannot import name 'Str' from 'std_msgs.msg'``.

    **Fix.** Use a name that the package defines; ``ros2-scaffold interfaces std_msgs`` lists
    them. Packages whose definitions are neither in the workspace nor installed nor bundled are
    not checked.

    **Source.** ``rosidl_generator_py``, which writes the ``__init__.py`` of ``std_msgs.msg``.
    """

    code = "MS001"
    name = "interface-unknown"
    examples = (
        Example(
            "known, or impossible to know",
            {
                "talker.py": "from std_msgs.msg import String\n"
                "from std_srvs.srv import SetBool, SetBool_Request\n"
                "from unheard_msgs.msg import Thing\n"
                "try:\n    from std_msgs.msg import Newer\nexcept ImportError:\n    Newer = None\n"
            },
        ),
        Example(
            "misspelled, from another package, of another kind",
            {
                "talker.py": "import std_msgs.msg\n"
                "from std_msgs.msg import Str\n"
                "from std_msgs.msg import Twist\n"
                "from std_msgs.srv import Empty\n"
                "from std_msgs.msgs import Bool\n\n"
                "message = std_msgs.msg.Sting()\n"
            },
            Report("2:26", "std_msgs.msg has no 'Str'; did you mean 'String'?"),
            Report("3:26", "std_msgs.msg has no 'Twist'; did you mean 'geometry_msgs/msg/Twist'?"),
            Report(
                "4:26",
                "std_msgs.srv has no 'Empty'; did you mean 'std_msgs/msg/Empty' or "
                "'std_srvs/srv/Empty'?",
            ),
            Report("5:27", "std_msgs has no module 'msgs'; did you mean 'std_msgs.msg'?"),
            Report("7:11", "std_msgs.msg has no 'Sting'; did you mean 'String'?"),
        ),
        Example(
            "imported without the module",
            {
                "talker.py": "from sensor_msgs import msg\n"
                "from std_msgs import Bool, msg as messages\n"
                "from std_srvs import Trigger\n"
                "from sensor_msgs_py import point_cloud2\n"
            },
            Report("2:22", "'Bool' is not in std_msgs: ImportError; it is in std_msgs.msg"),
            Report("3:22", "'Trigger' is not in std_srvs: ImportError; it is in std_srvs.srv"),
        ),
        Example(
            "a message that is gone",
            {"talker.py": "from geometry_msgs.msg import Pose2D\n"},
            Report(
                "1:31",
                "geometry_msgs.msg.Pose2D was removed in Lyrical: ImportError; use "
                "geometry_msgs/msg/Pose, or a message of your own with x, y and "
                "theta: which is right depends on who reads it (common_interfaces "
                "283)",
            ),
            distro="lyrical",
        ),
        Example(
            "from a package of the workspace",
            {"talker.py": "from my_msgs.msg import Beat, Bet\n"},
            Report("1:31", "my_msgs.msg has no 'Bet'; did you mean 'Beat'?"),
            neighbours={
                "my_msgs": {
                    "package.xml": "<package format='3'><name>my_msgs</name></package>\n",
                    "CMakeLists.txt": "project(my_msgs)\n"
                    "rosidl_generate_interfaces(${PROJECT_NAME} msg/Beat.msg)\n",
                    "msg/Beat.msg": "int32 count\n",
                }
            },
        ),
    )

    def check_file(self, types: MessageTypes) -> Iterator[Diagnostic]:
        for at, owner, kind, name in interfaces_named(types):
            message = _flaw(types.definitions, owner, kind, name)
            if message:
                yield self.report(at, message)


def _flaw(definitions: Definitions, owner: str, kind: str, name: str) -> str | None:
    if not kind:
        return _without_kind(definitions, owner, name)
    module = _MISSPELLED.get(kind.lower(), kind)
    names = definitions.names(owner, module)
    if names is None or name.startswith("_") or name == "*":
        return None
    if module != kind:
        return f"{owner} has no module {kind!r}; did you mean '{owner}.{module}'?"
    if kind not in KINDS or name in names or any(name.startswith(f"{x}_") for x in names):
        return None
    change = removed_interface(f"{owner}/{kind}/{name}")
    if change is not None:
        state = f"{change.state}: ImportError; {change.advice}"
        return f"{owner}.{kind}.{name} {state} ({change.source})"
    hint = closest_word(name, names)
    elsewhere = [match for match in definitions.matches(name) if match.endswith(f"/{name}")]
    if elsewhere and (not hint or not names):
        hint = f"; did you mean {' or '.join(map(repr, elsewhere[:3]))}?"
    return f"{owner}.{kind} has no {name!r}{hint}"


def _without_kind(definitions: Definitions, owner: str, name: str) -> str | None:
    """Return the message for ``from std_msgs import String``."""
    for kind in KINDS:
        names = definitions.names(owner, kind) or ()
        if name in names:
            return f"{name!r} is not in {owner}: ImportError; it is in {owner}.{kind}"
    return None
