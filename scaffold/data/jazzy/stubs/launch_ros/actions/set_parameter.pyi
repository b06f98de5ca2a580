from typing import Any

from launch.action import Action as Action
from launch.condition import Condition
from launch.some_substitutions_type import (
    SomeSubstitutionsType as SomeSubstitutionsType,
)
from launch_ros.parameters_type import SomeParameterValue as SomeParameterValue

class SetParameter(Action):
    def __init__(
        self,
        name: SomeSubstitutionsType,
        value: SomeParameterValue,
        *,
        condition: Condition | None = None,
    ) -> None: ...
    @property
    def name(self) -> Any: ...
    @property
    def value(self) -> Any: ...
