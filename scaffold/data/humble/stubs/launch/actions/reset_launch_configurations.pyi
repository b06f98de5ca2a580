from collections.abc import Mapping
from typing import Any
from launch.action import Action as Action
from launch.condition import Condition
from launch.some_substitutions_type import SomeSubstitutionsType as SomeSubstitutionsType
from ..frontend import Entity as Entity
from ..frontend import expose_action as expose_action
from ..frontend import Parser as Parser
from ..launch_context import LaunchContext as LaunchContext
from ..utilities import normalize_to_list_of_substitutions as normalize_to_list_of_substitutions
from ..utilities import perform_substitutions as perform_substitutions

class ResetLaunchConfigurations(Action):
    def __init__(
        self,
        launch_configurations: Mapping[Any, SomeSubstitutionsType] | None = None,
        *,
        condition: Condition | None = None,
    ) -> None: ...
