"""Conventional topic names, QoS and rates by message type."""

from __future__ import annotations

import os
from collections.abc import Mapping
from functools import cache

from scaffold.distributions import DATA
from scaffold.generate.questions.names import header_name
from scaffold.record import NamedTuple

_TABLE = os.path.join(DATA, "conventions.tsv")
_OF_ONE_TOPIC = "* "
"""The prefix of types whose convention only applies to a topic with this name."""
_VALUES = "std_msgs"
"""The package whose messages have no meaning of their own."""


class Convention(NamedTuple):
    """The conventions for a topic."""

    topic: str
    offered: str = "10"
    """The quality of service of publishers, as a user writes it."""
    requested: str = "10"
    """The quality of service of subscriptions."""
    rate: float = 2.0
    """Messages per second."""
    frame: str = ""
    """The frame of the header; empty if there is none."""


def of_message(full_name: str) -> Convention:
    """Return the conventions for messages of a type, such as ``sensor_msgs/msg/LaserScan``."""
    convention = table().get((full_name, ""))
    if convention is not None:
        return convention
    package, _, name = full_name.split("/")
    return Convention("example_topic" if package == _VALUES else header_name(name))


def of_topic(full_name: str, topic: str) -> Convention:
    """Return the conventions for a topic with messages of a type."""
    return table().get((full_name, topic.strip("~/")), of_message(full_name))


@cache
def table() -> Mapping[tuple[str, str], Convention]:
    """Return the table by type and topic; the topic is empty if it does not matter."""
    result: dict[tuple[str, str], Convention] = {}
    with open(_TABLE, encoding="utf-8") as file:
        for line in file:
            if line.startswith("#"):
                continue
            full_name, topic, offered, requested, rate, frame, _ = line.split("\t")
            key = full_name.removeprefix(_OF_ONE_TOPIC), ""
            if key[0] != full_name:
                key = key[0], topic
            frame = "" if frame == "-" else frame
            result[key] = Convention(topic, offered, requested, float(rate), frame)
    return result
