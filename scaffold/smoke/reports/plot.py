"""Plots the rate of a topic over time."""

from __future__ import annotations

import math
from dataclasses import dataclass

from scaffold.smoke.result import Topic

WIDTH, HEIGHT = 640, 180
LEFT, RIGHT, TOP, BOTTOM = 56, 16, 14, 34
_STEPS = 4
"""The number of grid lines, at round numbers."""


@dataclass(frozen=True)
class Tick:
    """A labeled value of an axis."""

    at: float
    label: str


@dataclass(frozen=True)
class Plot:
    """A line with its axes, in coordinates of the picture."""

    points: str
    rates: tuple[Tick, ...]
    times: tuple[Tick, ...]
    description: str


def of_topic(topic: Topic) -> Plot | None:
    """Return the plot of a topic; ``None`` if fewer than two rates are known."""
    if len(topic.rates) < 2:  # noqa: PLR2004  a line has two ends
        return None
    rates = _ticks(max(rate for _, rate in topic.rates))
    times = _ticks(topic.rates[-1][0])
    width, height = WIDTH - LEFT - RIGHT, HEIGHT - TOP - BOTTOM

    def across(seconds: float) -> float:
        return round(LEFT + width * seconds / times[-1], 1)

    def down(hertz: float) -> float:
        return round(TOP + height * (1 - hertz / rates[-1]), 1)

    lowest = min(rate for _, rate in topic.rates)
    highest = max(rate for _, rate in topic.rates)
    return Plot(
        points=" ".join(f"{across(seconds)},{down(rate)}" for seconds, rate in topic.rates),
        rates=tuple(Tick(down(rate), f"{rate:g}") for rate in rates),
        times=tuple(Tick(across(seconds), f"{seconds:g}") for seconds in times),
        description=f"between {lowest:.4g} and {highest:.4g} hertz in "
        f"{topic.rates[-1][0]:.1f} seconds",
    )


def _ticks(greatest: float) -> list[float]:
    """Return round numbers from 0 to at least the maximum."""
    greatest = max(greatest, 1e-6)
    rough = greatest / _STEPS
    power = 10.0 ** math.floor(math.log10(rough))
    step = next(factor * power for factor in (1, 2, 2.5, 5, 10) if factor * power >= rough)
    return [step * number for number in range(math.ceil(greatest / step - 1e-9) + 1)]
