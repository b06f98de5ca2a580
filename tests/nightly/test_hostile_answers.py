"""Every hostile answer to every question of `new`, one at a time."""

from __future__ import annotations

import pytest

from scaffold.generate.templates.template import Question
from tests.generate.test_hostile_answers import ASKED, answers, check_alone

pytestmark = [pytest.mark.nightly, pytest.mark.timeout(0)]


@pytest.mark.parametrize(
    ("kind", "question"), [pytest.param(*item, id=f"{item[0]}-{item[1].name}") for item in ASKED]
)
def test_each_hostile_answer_alone(kind: str, question: Question) -> None:
    check_alone(kind, question, answers(kind, question))
