from typing import Any
from launch.launch_context import LaunchContext
from launch.launch_description_entity import LaunchDescriptionEntity
from launch.some_substitutions_type import SomeSubstitutionsType
from launch.substitution import Substitution
from launch.utilities import type_utils as type_utils, create_future_impl as create_future_impl
from .class_tools_impl import (
    is_a as is_a,
    is_a_subclass as is_a_subclass,
    isclassinstance as isclassinstance,
)
from .create_future_impl import create_future as create_future
from .ensure_argument_type_impl import ensure_argument_type as ensure_argument_type
from .normalize_to_list_of_substitutions_impl import (
    normalize_to_list_of_substitutions as normalize_to_list_of_substitutions,
)
from .perform_substitutions_impl import perform_substitutions as perform_substitutions
from .signal_management import AsyncSafeSignalManager as AsyncSafeSignalManager
from .visit_all_entities_and_collect_futures_impl import (
    visit_all_entities_and_collect_futures as visit_all_entities_and_collect_futures,
)

def is_a(obj: Any, entity_type: Any) -> bool: ...
def is_a_subclass(obj: Any, entity_type: Any) -> bool: ...
def isclassinstance(obj: Any) -> bool: ...
def ensure_argument_type(
    argument: Any, types: Any, argument_name: str, caller: str | None = None
) -> None: ...
def normalize_to_list_of_entities(entities: Any) -> list[LaunchDescriptionEntity]: ...
def normalize_to_list_of_substitutions(subs: SomeSubstitutionsType) -> list[Substitution]: ...
def perform_substitutions(context: LaunchContext, subs: Any) -> str: ...
def visit_all_entities_and_collect_futures(entity: Any, context: Any) -> Any: ...

AsyncSafeSignalManager: Any

def __getattr__(name: str) -> Any: ...
