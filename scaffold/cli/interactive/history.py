"""The answers so far, for going back to the previous question."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar

BACK = "<"
"""The key to go back; no answer ends with it."""

Answer = TypeVar("Answer")


class BackError(Exception):
    """The user wants to return to the previous question."""


class History:
    """The answers given so far.

    To go back, the interview starts over: `ask` returns earlier answers without asking, up
    to the question to be asked again. So questions may depend on each other in
    any way.
    """

    def __init__(self) -> None:
        self._answers: list[Any] = []
        self._next = 0
        self._taken_back: Any = None

    @property
    def is_repeated(self) -> bool:
        """Whether the user has answered the next question before."""
        return self._next < len(self._answers)

    @property
    def position(self) -> int:
        """The number of answered questions."""
        return self._next

    def ask(self, prompt: Callable[[Any], Answer]) -> Answer:
        """Return an answer.

        Args:
            prompt: Asks the user, given the answer that was taken back, or ``None``.

        Raises:
            BackError: the user wants to go back.
        """
        if not self.is_repeated:
            taken_back, self._taken_back = self._taken_back, None
            self._answers.append(prompt(taken_back))
        self._next += 1
        answer: Answer = self._answers[self._next - 1]
        return answer

    def back(self) -> None:
        """Take the last answer back and start over."""
        self._taken_back = self._answers.pop() if self._answers else None
        self._next = 0

    def forget(self, position: int) -> None:
        """Take back all answers since a position."""
        del self._answers[position:]
        self._next = position
