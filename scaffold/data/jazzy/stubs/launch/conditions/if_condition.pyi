from launch.condition import Condition as Condition
from launch.some_substitutions_type import (
    SomeSubstitutionsType as SomeSubstitutionsType,
)

class IfCondition(Condition):
    def __init__(self, predicate_expression: SomeSubstitutionsType) -> None: ...
