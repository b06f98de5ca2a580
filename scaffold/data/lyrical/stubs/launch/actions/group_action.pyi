from collections.abc import Iterable, Mapping
from typing import Any
from launch.action import Action as Action
from launch.condition import Condition
from launch.launch_description_entity import LaunchDescriptionEntity
from launch.some_substitutions_type import SomeSubstitutionsType as SomeSubstitutionsType
from .pop_environment import PopEnvironment as PopEnvironment
from .pop_launch_configurations import PopLaunchConfigurations as PopLaunchConfigurations
from .push_environment import PushEnvironment as PushEnvironment
from .push_launch_configurations import PushLaunchConfigurations as PushLaunchConfigurations
from .reset_environment import ResetEnvironment as ResetEnvironment
from .reset_launch_configurations import ResetLaunchConfigurations as ResetLaunchConfigurations
from .set_launch_configuration import SetLaunchConfiguration as SetLaunchConfiguration
from ..frontend import Entity as Entity
from ..frontend import expose_action as expose_action
from ..frontend import Parser as Parser
from ..launch_context import LaunchContext as LaunchContext

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
