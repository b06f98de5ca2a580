from collections.abc import Iterable
from typing import Any, TypeAlias

from launch.launch_description_entity import LaunchDescriptionEntity

SomeEntitiesType: TypeAlias = LaunchDescriptionEntity | Iterable[LaunchDescriptionEntity]
SomeEntitiesType_types_tuple: tuple[Any, ...]
