"""Parses quality of service from the command line, and renders it for rclpy.

Users write a depth, the name of a profile, or settings separated by commas, such as
``best_effort,depth=5``. A setting is ``key=value``, a value that only one key has, a depth, or a
profile that provides the other settings.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from difflib import get_close_matches

from scaffold.errors import InputError
from scaffold.model.rclpy.topics.qos import PROFILES
from scaffold.record import NamedTuple

MAX_DEPTH = 10_000
MAX_SECONDS = 1_000_000.0
CONSTANT = "QOS"
"""The constant in a module for a quality of service built from settings."""
_MAX_COLUMNS = 99


class Qos(NamedTuple):
    """The quality of service of a publisher or a subscription."""

    expression: str
    """The argument for ``create_publisher`` and ``create_subscription``."""
    imports: tuple[str, ...]
    summary: str
    """A description in words."""
    constants: tuple[str, ...] = ()
    """Lines of the module that the expression needs."""
    hint: str = "here the maximum number of messages in the queue"
    """An explanation of the expression, for learners."""
    text: str = ""
    """What the user wrote."""
    reliability: str = "reliable"
    """Empty where it depends on the middleware."""
    durability: str = "volatile"
    """Likewise."""

    @property
    def assignment(self) -> str:
        """Lines of a module that assign it to ``QOS``."""
        return "\n".join(self.constants) or f"{CONSTANT} = {self.expression}"

    def named(self, name: str) -> Qos:
        """Return the same quality of service with another constant, for modules with two."""
        constants = tuple(
            line.replace(f"{CONSTANT} = ", f"{name} = ", 1) for line in self.constants
        )
        expression = name if self.constants else self.expression
        return self._replace(expression=expression, constants=constants)


_SAYS: Mapping[str, str] = {
    "action_status_default": "reliable, late subscribers receive the last message",
    "parameter_events": "reliable, depth 1000",
    "parameters": "reliable, depth 1000",
    "sensor_data": "best effort, depth 5",
    "services_default": "reliable, depth 10",
    "system_default": "the default of the middleware",
}
"""The profiles of ``rclpy.qos`` that suit a topic."""

_OWN: Mapping[str, Mapping[str, str]] = {
    "latched": {"depth": "1", "reliability": "reliable", "durability": "transient_local"}
}
"""Profiles that rclpy has no name for."""

NAMES = ("default", *_SAYS, *_OWN)

COMMON: Mapping[str, str] = {
    "default": "reliable, a queue of 10 messages: commands, states, events",
    "sensor_data": "best effort, a queue of 5: sensors, where only new values matter",
    "latched": "reliable, late subscribers receive the last one: maps, descriptions",
    "system_default": _SAYS["system_default"],
}
"""Suggestions for most topics, with their purpose."""

_POLICIES: Mapping[str, tuple[str, ...]] = {
    "history": ("keep_last", "keep_all"),
    "reliability": ("reliable", "best_effort"),
    "durability": ("volatile", "transient_local"),
    "liveliness": ("automatic", "manual_by_topic"),
}
_DURATIONS = ("lifespan", "deadline", "liveliness_lease_duration")
"""In seconds."""
_KEYS = (
    *("history", "depth", "reliability", "durability"),
    *("lifespan", "deadline", "liveliness", "liveliness_lease_duration"),
)
"""The settings in the order of rclpy."""
_KEY_OF: Mapping[str, str] = {value: key for key, values in _POLICIES.items() for value in values}


def qos(text: str) -> Qos:
    """Return a quality of service for a depth, the name of a profile, or settings.

    Raises:
        InputError: it is neither; the message names the closest words.
    """
    name, *others = words = [word.strip() for word in text.split(",")]
    if not others and name in _SAYS:
        constant = f"qos_profile_{name}"
        _, _, reliability, durability = (str(value).lower() for value in PROFILES[name])
        return Qos(
            constant,
            (f"from rclpy.qos import {constant}",),
            f"{name}: {_SAYS[name]}",
            hint="here a predefined profile of rclpy",
            text=text,
            reliability="" if reliability == "system_default" else reliability,
            durability="" if durability == "system_default" else durability,
        )
    base = _of_profile(name) if name in NAMES else {}
    settings = {**base, **_settings(others if base else words, text)}
    if settings.get("history") == "keep_all":
        settings.pop("depth", None)
    else:
        settings.setdefault("depth", str(PROFILES["default"][0]))
    if list(settings) == ["depth"]:
        return Qos(settings["depth"], (), f"reliable, depth {settings['depth']}", text=text)
    made = _profile(settings, name if name in _OWN and not others else "")
    return made._replace(
        text=text,
        reliability=settings.get("reliability", made.reliability),
        durability=settings.get("durability", made.durability),
    )


def _of_profile(name: str) -> Mapping[str, str]:
    """Return the settings in which a profile differs from the default, and its depth."""
    if name in _OWN:
        return _OWN[name]
    (depth, *values), (_, *defaults) = PROFILES[name], PROFILES["default"]
    policies = zip(_POLICIES, values, defaults, strict=False)
    differing = {key: value.lower() for key, value, default in policies if value != default}
    return {"depth": str(depth), **differing}


def _settings(words: Sequence[str], text: str) -> dict[str, str]:
    """Parse the settings given by the user.

    Raises:
        InputError: one is invalid, or contradicts another one.
    """
    result: dict[str, str] = {}
    for word in words:
        key, equals, value = (part.strip() for part in word.partition("="))
        if not equals:
            key, value = _KEY_OF.get(word, "depth" if _is_depth(word) else ""), word
        if key not in _KEYS:
            raise InputError(_unknown(text, word))
        if key in result:
            raise InputError(
                f"the quality of service {text!r} sets {key} twice: {result[key]} and {value}"
            )
        result[key] = _checked(key, value, text)
    return result


def _checked(key: str, value: str, text: str) -> str:
    """Return the value of a setting.

    Raises:
        InputError: it is invalid for the setting.
    """
    if key in _POLICIES:
        if value not in _POLICIES[key]:
            wanted = " or ".join(_POLICIES[key])
            raise InputError(f"the quality of service {text!r}: {key} is {wanted}, not {value!r}")
        return value
    if key in _DURATIONS:
        if not re.fullmatch(r"\d{1,9}(\.\d{1,9})?", value, re.ASCII) or not (
            0.0 < float(value) <= MAX_SECONDS
        ):
            raise InputError(
                f"the quality of service {text!r}: {key} is a number of seconds, not {value!r}"
            )
        return value
    if not _is_depth(value):
        raise InputError(
            f"the quality of service {text!r}: the depth is 1 to {MAX_DEPTH}, not {value!r}"
        )
    return str(int(value))


def _is_depth(word: str) -> bool:
    return re.fullmatch(r"[0-9]{1,9}", word) is not None and 0 < int(word) <= MAX_DEPTH


def _unknown(text: str, word: str) -> str:
    words = [*NAMES, *_KEY_OF, *_KEYS]
    wanted = word.partition("=")[0].strip().lower().replace("-", "_")
    closest = get_close_matches(wanted, words, n=2, cutoff=0.7)
    hint = f"; did you mean {' or '.join(closest)}?" if closest else ""
    if "," in text or "=" in text:
        return (
            f"the quality of service {text!r} has an unknown setting {word!r}; the settings are "
            f"{', '.join(_KEYS)}{hint}"
        )
    return (
        f"the quality of service {text!r} is neither a depth from 1 to {MAX_DEPTH} nor one of "
        f"{', '.join(NAMES)} nor settings such as best_effort,depth=5{hint}"
    )


def _profile(settings: Mapping[str, str], name: str) -> Qos:
    """Return the call that builds a profile from settings."""
    classes, imports = {"QoSProfile"}, set()
    arguments: list[str] = []
    for key in [key for key in _KEYS if key in settings]:
        value = settings[key]
        if key in _POLICIES:
            policy = f"{key.capitalize()}Policy"
            classes.add(policy)
            value = f"{policy}.{value.upper()}"
        elif key in _DURATIONS:
            imports.add("from rclpy.duration import Duration")
            value = f"Duration(seconds={float(value)})"
        arguments.append(f"{key}={value}")
    imports.add(f"from rclpy.qos import {', '.join(sorted(classes))}")
    whole = f"{CONSTANT} = QoSProfile({', '.join(arguments)})"
    lines = [f"{CONSTANT} = QoSProfile(", *(f"    {argument}," for argument in arguments), ")"]
    return Qos(
        CONSTANT,
        tuple(sorted(imports)),
        (f"{name}: " if name else "") + _in_words(settings),
        (whole,) if len(whole) <= _MAX_COLUMNS else tuple(lines),
        hint="here the profile defined above",
    )


def _in_words(settings: Mapping[str, str]) -> str:
    words = [settings.get("reliability", "reliable")]
    words += [settings[key] for key in ("history", "durability") if key in settings]
    words += [f"depth {settings['depth']}"] if "depth" in settings else []
    words += [f"{key} {float(settings[key]):g} s" for key in _DURATIONS if key in settings]
    words += [f"liveliness {settings['liveliness']}"] if "liveliness" in settings else []
    return ", ".join(words).replace("_", " ")
