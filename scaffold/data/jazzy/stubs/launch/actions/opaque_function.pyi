from collections.abc import Callable, Iterable
from typing import Any

from launch.action import Action as Action
from launch.condition import Condition
from launch.launch_description_entity import LaunchDescriptionEntity

class OpaqueFunction(Action):
    def __init__(
        self,
        *,
        function: Callable[..., Iterable[LaunchDescriptionEntity] | None],
        args: Iterable[Any] | None = None,
        kwargs: dict[str, Any] | None = None,
        condition: Condition | None = None,
    ) -> None: ...
