from typing import Any
from typing import Iterable
from typing import Union
from .launch_description_entity import LaunchDescriptionEntity as LaunchDescriptionEntity

SomeActionsType = Union[LaunchDescriptionEntity, Iterable[LaunchDescriptionEntity]]
SomeActionsType_types_tuple: Any
