from collections.abc import Mapping
from typing import Any

from launch.action import Action as Action
from launch.condition import Condition
from launch.some_substitutions_type import (
    SomeSubstitutionsType as SomeSubstitutionsType,
)

class ResetLaunchConfigurations(Action):
    def __init__(
        self,
        launch_configurations: Mapping[Any, SomeSubstitutionsType] | None = None,
        *,
        condition: Condition | None = None,
    ) -> None: ...
