from collections.abc import Iterable

from launch.actions.timer_action import TimerAction
from launch.condition import Condition
from launch.launch_description_entity import LaunchDescriptionEntity
from launch.some_substitutions_type import (
    SomeSubstitutionsType as SomeSubstitutionsType,
)

class ROSTimer(TimerAction):
    def __init__(
        self,
        *,
        period: float | SomeSubstitutionsType,
        actions: Iterable[LaunchDescriptionEntity],
        cancel_on_shutdown: bool | SomeSubstitutionsType = True,
        condition: Condition | None = None,
    ) -> None: ...
