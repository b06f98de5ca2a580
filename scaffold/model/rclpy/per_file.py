"""Results that are computed once for a file with rclpy code."""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from typing import TYPE_CHECKING, TypeVar

if TYPE_CHECKING:
    from scaffold.model.rclpy.file import RclpyFile

Result = TypeVar("Result")


def per_file(find: Callable[[RclpyFile], Result]) -> Callable[[RclpyFile], Result]:
    """Decorate a function of a file: its result is kept as long as the file.

    The function must not call itself, not even through others.
    """

    @wraps(find)
    def once(file: RclpyFile) -> Result:
        if find not in file.results:
            file.results[find] = find(file)
        result: Result = file.results[find]
        return result

    return once
