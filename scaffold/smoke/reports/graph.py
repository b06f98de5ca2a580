"""Draws the nodes and topics of an executable as a layered graph."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from scaffold.smoke.result import Observation

MOST_BOXES = 60
"""The maximum number of nodes and topics in a readable picture."""
_BOX_HEIGHT = 34
_GAP = 16
_BETWEEN_LAYERS = 70
_LETTER = 7.4
_MAX_LETTERS = 34
_MARGIN = 10

Name = tuple[str, str]
"""``node`` or ``topic``, and its name."""
Arrow = tuple[Name, Name]


@dataclass(frozen=True)
class Box:
    """A node or a topic."""

    kind: str
    name: str
    label: str
    """The name, shortened to fit."""
    x: float
    y: float
    width: float
    height: float = _BOX_HEIGHT

    @property
    def middle(self) -> tuple[float, float]:
        """The place of the label."""
        return self.x + self.width / 2, self.y + self.height / 2


@dataclass(frozen=True)
class Graph:
    """A picture of boxes and of arrows between them."""

    width: float
    height: float
    boxes: tuple[Box, ...]
    arrows: tuple[str, ...]
    """Paths as SVG writes them."""
    sentences: tuple[str, ...]
    """The same in words."""
    left_out: int = 0


def of_observation(seen: Observation) -> Graph | None:
    """Return the picture; ``None`` if there is nothing to show."""
    arrows = _arrows(seen)
    names = [*(("node", node) for node in seen.nodes), *(name for pair in arrows for name in pair)]
    every = list(dict.fromkeys(names))
    shown = every[:MOST_BOXES]
    if not shown:
        return None
    arrows = [pair for pair in arrows if pair[0] in shown and pair[1] in shown]
    boxes = _layout(_layers(shown, arrows), arrows)
    return Graph(
        width=max(box.x + box.width for box in boxes.values()) + _MARGIN,
        height=max(box.y + box.height for box in boxes.values()) + _MARGIN,
        boxes=tuple(boxes.values()),
        arrows=tuple(_path(boxes[begin], boxes[end]) for begin, end in arrows),
        sentences=tuple(
            f"{begin[1]} publishes {end[1]}"
            if begin[0] == "node"
            else f"{end[1]} subscribes to {begin[1]}"
            for begin, end in arrows
        ),
        left_out=len(every) - len(shown),
    )


def _arrows(seen: Observation) -> list[Arrow]:
    arrows: list[Arrow] = []
    for topic in seen.topics:
        for endpoint in topic.endpoints:
            node, name = ("node", endpoint.node), ("topic", topic.name)
            arrows.append((node, name) if endpoint.kind == "publisher" else (name, node))
    return list(dict.fromkeys(arrows))


def _layers(names: Sequence[Name], arrows: Sequence[Arrow]) -> list[list[Name]]:
    """Put each name right of its predecessors; arrows that close a cycle are ignored."""
    forward = _without_circles(names, arrows)
    layer = dict.fromkeys(names, 0)
    for _ in names:
        moved = False
        for begin, end in forward:
            if layer[end] <= layer[begin]:
                layer[end] = layer[begin] + 1
                moved = True
        if not moved:
            break
    return [[name for name in names if layer[name] == at] for at in range(max(layer.values()) + 1)]


def _without_circles(names: Sequence[Name], arrows: Sequence[Arrow]) -> list[Arrow]:
    following: dict[Name, list[Name]] = {name: [] for name in names}
    kept: list[Arrow] = []
    for begin, end in arrows:
        if not _is_reachable(following, end, begin):
            following[begin].append(end)
            kept.append((begin, end))
    return kept


def _is_reachable(following: dict[Name, list[Name]], begin: Name, end: Name) -> bool:
    waiting, visited = [begin], {begin}
    while waiting:
        name = waiting.pop()
        if name == end:
            return True
        new = [item for item in following[name] if item not in visited]
        visited.update(new)
        waiting += new
    return False


def _layout(layers: Iterable[list[Name]], arrows: Sequence[Arrow]) -> dict[Name, Box]:
    """Place the layers next to each other, with names at the height of their neighbors."""
    boxes: dict[Name, Box] = {}
    x = float(_MARGIN)
    for layer in layers:
        heights = {name: _height_of_neighbors(name, arrows, boxes) for name in layer}
        labels = {name: _label(name[1]) for name in layer}
        width = max((len(label) for label in labels.values()), default=0) * _LETTER + 24
        for row, name in enumerate(sorted(layer, key=lambda item: heights[item])):
            y = _MARGIN + row * (_BOX_HEIGHT + _GAP)
            boxes[name] = Box(name[0], name[1], labels[name], x, y, width)
        x += width + _BETWEEN_LAYERS
    return boxes


def _height_of_neighbors(name: Name, arrows: Sequence[Arrow], boxes: dict[Name, Box]) -> float:
    heights = [
        boxes[other].y
        for begin, end in arrows
        for node, other in ((begin, end), (end, begin))
        if node == name and other in boxes
    ]
    return sum(heights) / len(heights) if heights else 0.0


def _label(name: str) -> str:
    return name if len(name) <= _MAX_LETTERS else name[: _MAX_LETTERS - 1] + "…"


def _path(begin: Box, end: Box) -> str:
    """Return a curve from the right of a box to the left of another, or around it."""
    x1, y1 = begin.x + begin.width, begin.middle[1]
    x2, y2 = end.x, end.middle[1]
    if x2 > x1:
        bend = (x1 + x2) / 2
        return f"M{x1:.1f},{y1:.1f} C{bend:.1f},{y1:.1f} {bend:.1f},{y2:.1f} {x2:.1f},{y2:.1f}"
    y1, y2 = begin.y + begin.height, end.y + end.height
    x1, x2 = begin.middle[0], end.middle[0]
    low = max(y1, y2) + _GAP
    return f"M{x1:.1f},{y1:.1f} C{x1:.1f},{low:.1f} {x2:.1f},{low:.1f} {x2:.1f},{y2:.1f}"
