from collections.abc import Iterable, Mapping
from typing import Any

from launch.action import Action as Action
from launch.condition import Condition
from launch.launch_description_entity import LaunchDescriptionEntity
from launch.some_substitutions_type import (
    SomeSubstitutionsType as SomeSubstitutionsType,
)

class GroupAction(Action):
    def __init__(
        self,
        actions: Iterable[LaunchDescriptionEntity],
        *,
        scoped: bool = True,
        forwarding: bool = True,
        launch_configurations: Mapping[Any, SomeSubstitutionsType] | None = None,
        condition: Condition | None = None,
    ) -> None: ...
