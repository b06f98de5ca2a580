"""The HTML report of a smoke run: one self-contained page."""

from __future__ import annotations

import os
from typing import Any

from scaffold.errors import InputError
from scaffold.printable import printable
from scaffold.smoke.reports import details, graph, plot, text
from scaffold.smoke.result import Smoke, Spread
from scaffold.smoke.run import ending

NAME = "index.html"


def write(result: Smoke, directory: str) -> str:
    """Write the page; return its path.

    Raises:
        InputError: the directory cannot be created, or the page cannot be written.
    """
    path = os.path.join(directory, NAME)
    content = page(result)
    try:
        os.makedirs(directory, exist_ok=True)
        with open(path, "w", encoding="utf-8") as file:
            file.write(content)
    except OSError as error:
        raise InputError(f"--report {directory}: {error.strerror or error}") from error
    return path


def page(result: Smoke) -> str:
    """Return the page; the template escapes all foreign text."""
    from jinja2 import Environment, FileSystemLoader, StrictUndefined

    environment = Environment(
        loader=FileSystemLoader(os.path.dirname(__file__)),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters.update(
        flow=lambda value: printable(details.flow(value)),
        size=details.size,
        own=details.own_parameters,
        milliseconds=_milliseconds,
        words=lambda value: str(value).replace("_", " "),
    )
    names: dict[str, Any] = {
        "graph": graph.of_observation,
        "plot": plot.of_topic,
        "ending": ending,
        "size_of_plot": plot,
    }
    clean = text.without_escapes(result)
    template = environment.get_template("page.html.jinja")
    return template.render(result=clean, summary=text.summary(clean), **names)


def _milliseconds(spread: Spread | None, name: str) -> str:
    return "" if spread is None else f"{getattr(spread, name) * 1e3:.2f}"
