from typing import Any

VALID_TRUE_EXPRESSIONS: list[str]
VALID_FALSE_EXPRESSIONS: list[str]

def evaluate_condition_expression(context: Any, expression: Any) -> bool: ...
