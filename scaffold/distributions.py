"""The distributions of ROS 2: their properties, and the current target.

The differences between distributions are data in ``scaffold/data/<name>/``. Code asks the target
for a property, never for its name.
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from functools import cached_property
from typing import Any

from scaffold import toml
from scaffold.errors import InputError

DATA = os.path.join(os.path.dirname(os.path.abspath(__file__)), "data")
ORDER = tuple(
    name
    for name in sorted(os.listdir(DATA))
    if os.path.exists(os.path.join(DATA, name, "profile.toml"))
)
"""Those with their own data, oldest first, in alphabetical order."""
ALIASES: Mapping[str, str] = {"rolling": ORDER[-1]}
"""Aliases of distributions that are equal for Python packages at present."""
NAMES = (*ORDER, *ALIASES)
OF_ROS1 = frozenset({"groovy", "hydro", "indigo", "jade", "kinetic", "lunar", "melodic", "noetic"})
ENDED_ROS2 = frozenset(
    {"ardent", "bouncy", "crystal", "dashing", "eloquent", "foxy", "galactic", "iron"}
)
ENDED = OF_ROS1 | ENDED_ROS2
"""Those no longer supported, including ROS 1, which may still be named."""
DEFAULT = "jazzy"
VARIABLE = "ROS_DISTRO"
"""The variable of an environment that names its distribution."""


class Distribution:
    """A distribution of ROS 2 and its properties.

    Args:
        name: One of ``NAMES``.
    """

    def __init__(self, name: str) -> None:
        self.name = name
        self.title = name.capitalize()
        self._directory = os.path.join(DATA, ALIASES.get(name, name))

    @cached_property
    def place(self) -> int:
        """Its place in time: a later distribution has a higher one."""
        return ORDER.index(ALIASES.get(self.name, self.name))

    def path(self, file: str) -> str:
        """Return the path of a file of its data."""
        return os.path.join(self._directory, file)

    @cached_property
    def profile(self) -> Mapping[str, Any]:
        """The facts of ``profile.toml``."""
        return toml.read_toml(self.path("profile.toml"))

    @cached_property
    def python(self) -> tuple[int, int]:
        """The version of Python that it runs on."""
        major, minor = self.profile["python"].split(".")
        return int(major), int(minor)

    @property
    def python_version(self) -> str:
        """The same as ``3.12``."""
        return ".".join(map(str, self.python))

    def fact(self, name: str) -> Any:  # noqa: ANN401  a text, a number, a list
        """Return a fact of the profile, ``section.name``."""
        value: Any = self.profile
        for part in name.split("."):
            value = value[part]
        return value


_KNOWN: dict[str, Distribution] = {}


def named(name: str, origin: str = "", advice: str = "name one") -> Distribution:
    """Return a distribution.

    Args:
        name: The given name.
        origin: The origin, for the message.
        advice: The advice if it names several.

    Raises:
        InputError: there is no such distribution.
    """
    if name not in NAMES:
        message = refusal(name, advice)
        raise InputError(f"{origin}: {message}" if origin else message)
    if name not in _KNOWN:
        _KNOWN[name] = Distribution(name)
    return _KNOWN[name]


def nearest(name: str) -> Distribution:
    """Return the distribution with the closest data: the next later one."""
    if name in NAMES:
        return named(name)
    return named(next((later for later in ORDER if later > name), ORDER[-1]))


def refusal(name: object, advice: str = "name one") -> str:
    """Return the message about an unknown distribution.

    Args:
        name: The given name.
        advice: The advice if it names several.
    """
    from difflib import get_close_matches

    text = str(name).lower()
    if len(text.replace(",", " ").split()) > 1:
        return f"{name!r} is more than one distribution; {advice}"
    choices = f"choose from {', '.join(NAMES)}"
    if text in ENDED:
        return f"{name!r} {ending(text)}; {choices}"
    closest = get_close_matches(text, NAMES, n=1)
    return f"no distribution {name!r}; {f'did you mean {closest[0]!r}?' if closest else choices}"


def ending(name: str) -> str:
    """Return the message about an ended distribution."""
    if name in OF_ROS1:
        return "is a ROS 1 distribution"
    return "has reached its end of life" if name in ENDED else "is not a known distribution"


def several(text: str, origin: str = "") -> list[Distribution]:
    """Parse a comma-separated list of distributions, each once, oldest first.

    Args:
        text: The given name.
        origin: The origin, for the message.

    Raises:
        InputError: a distribution is unknown, or there is no name.
    """
    words = [word.strip() for word in text.split(",") if word.strip()]
    if not words:
        problem = f"no distribution is given; choose from {', '.join(NAMES)}"
        raise InputError(f"{origin}: {problem}" if origin else problem)
    return ordered([named(word, origin, "separate them with commas") for word in words])


def ordered(distributions: Sequence[Distribution]) -> list[Distribution]:
    """Return distributions, each once, oldest first."""
    by_name = {distribution.name: distribution for distribution in distributions}
    return [by_name[name] for name in NAMES if name in by_name]


JAZZY = named(DEFAULT)
_target = JAZZY
"""What this process checks for. The verdict on a package is that of one distribution, from the
first file that is read to the last: what is remembered of packages must not outlive a change."""
_origin: Distribution | None = None
_kept: tuple[Distribution, ...] = ()


def origin() -> Distribution | None:
    """Return the distribution from which packages are migrated to the target."""
    return _origin


def kept() -> tuple[Distribution, ...]:
    """Return the distributions on which packages must still run besides the target."""
    return _kept


def target() -> Distribution:
    """Return the distribution that packages are checked for."""
    return _target


@contextmanager
def targeting(
    distribution: Distribution,
    origin: Distribution | None = None,
    kept: Sequence[Distribution] = (),
) -> Iterator[None]:
    """Set the target within the block; packages must be read inside of it.

    Args:
        distribution: The target.
        origin: See `origin`.
        kept: See `kept`.
    """
    global _target, _origin, _kept
    before = (_target, _origin, _kept)
    _target, _origin, _kept = distribution, origin, tuple(kept)
    try:
        yield
    finally:
        _target, _origin, _kept = before


def titles(distributions: Sequence[Distribution]) -> str:
    """Return ``Jazzy``, ``Jazzy and Lyrical``, ``Jazzy, Kilted and Lyrical``."""
    return enumerated(distribution.title for distribution in distributions)


def enumerated(words: Iterable[str]) -> str:
    """Return ``a``, ``a and b``, ``a, b and c``."""
    *rest, last = words
    return f"{', '.join(rest)} and {last}" if rest else last
