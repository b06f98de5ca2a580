from typing import Any

class InvalidConditionExpressionError(ValueError):
    def __init__(
        self, expression: str, unexpanded_expression: Any, valid_expressions: list[str]
    ) -> None: ...
