from collections.abc import Iterable
from typing import Any

from launch.action import Action as Action
from launch.condition import Condition
from launch.launch_description_entity import (
    LaunchDescriptionEntity as LaunchDescriptionEntity,
)
from launch.some_substitutions_type import (
    SomeSubstitutionsType as SomeSubstitutionsType,
)

class TimerAction(Action):
    def __init__(
        self,
        *,
        period: float | SomeSubstitutionsType,
        actions: Iterable[LaunchDescriptionEntity],
        cancel_on_shutdown: bool | SomeSubstitutionsType = True,
        condition: Condition | None = None,
    ) -> None: ...
    @property
    def period(self) -> Any: ...
    @property
    def actions(self) -> list[LaunchDescriptionEntity]: ...
    def handle(self, context: Any) -> Any: ...
    def cancel(self) -> None: ...
