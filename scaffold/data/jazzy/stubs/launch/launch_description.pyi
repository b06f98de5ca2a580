from collections.abc import Iterable
from typing import Any

from launch.action import Action as Action
from launch.actions.declare_launch_argument import DeclareLaunchArgument
from launch.launch_description_entity import (
    LaunchDescriptionEntity as LaunchDescriptionEntity,
)

class LaunchDescription(LaunchDescriptionEntity):
    def __init__(
        self,
        initial_entities: Iterable[LaunchDescriptionEntity] | None = None,
        *,
        deprecated_reason: str | None = None,
    ) -> None: ...
    def get_launch_arguments(
        self, conditional_inclusion: bool = False
    ) -> list[DeclareLaunchArgument]: ...
    def get_launch_arguments_with_include_launch_description_actions(
        self, conditional_inclusion: bool = False
    ) -> list[tuple[DeclareLaunchArgument, list[Any]]]: ...
    @property
    def entities(self) -> list[LaunchDescriptionEntity]: ...
    def add_entity(self, entity: LaunchDescriptionEntity) -> None: ...
    def add_action(self, action: LaunchDescriptionEntity) -> None: ...
    @property
    def deprecated(self) -> bool: ...
    @property
    def deprecated_reason(self) -> str | None: ...
