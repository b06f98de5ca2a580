"""MS021: publishers and subscriptions spell a topic the same way."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule, Severity
from scaffold.api.programs import NamedEndpoint, one_sided

_SHORTEST = 5
_NODE = (
    "from rclpy.node import Node\nfrom std_msgs.msg import String\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "        self.create_{}\n"
)


class TopicNameDiffers(Rule):
    """The topic of a subscription differs by one letter from one that is published.

    **Why.** Nothing arrives, and there is no error. Only names of the same type that have no
    other end in the package are reported.

    **Fix.** Spell both the same way, preferably with one constant.

    **Source.** ROS 2 documentation, "Understanding topics".
    """

    code = "MS021"
    name = "topic-name-differs"
    severity = Severity.WARNING
    examples = (
        Example(
            "the same name",
            {
                "a.py": _NODE.format("publisher(String, 'chatter', 10)"),
                "b.py": _NODE.format("subscription(String, 'chatter', print, 10)"),
            },
        ),
        Example(
            "a missing letter",
            {
                "a.py": _NODE.format("publisher(String, 'chatter', 10)"),
                "b.py": _NODE.format("subscription(String, 'chater', print, 10)"),
            },
            Report("b.py:8:42", "no publisher for 'chater'; did you mean 'chatter' (a.py:8)?"),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        sent, awaited = one_sided(package)
        for topic in awaited:
            for other in sent:
                here, there = topic.subscriptions[0], other.publishers[0]
                if topic.is_plain and other.is_plain and _is_slip(here, there):
                    place = f"{there.location.path}:{there.location.line}"
                    message = (
                        f"no publisher for {here.name!r}; did you mean {there.name!r} ({place})?"
                    )
                    yield self.report(here.name_location, message)
                    break


def _is_slip(here: NamedEndpoint, there: NamedEndpoint) -> bool:
    """Return whether two names of the same type differ by one letter or in case."""
    name, other = here.name.strip("/"), there.name.strip("/")
    if here.interface is None or here.interface != there.interface or name == other:
        return False
    if name.lower() == other.lower():
        return True
    short, long = sorted((name, other), key=len)
    if len(short) < _SHORTEST or len(long) - len(short) > 1 or any(map(str.isdigit, name + other)):
        return False
    same = next((i for i, letter in enumerate(short) if letter != long[i]), len(short))
    rest = same if len(long) > len(short) else same + 1
    return short[rest:] == long[same + 1 :]
