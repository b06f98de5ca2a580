from launch import actions as actions, some_actions_type as some_actions_type
from launch import conditions as conditions
from launch import descriptions as descriptions
from launch import event_handlers as event_handlers
from launch import events as events
from launch import frontend as frontend
from launch import launch_description_sources as launch_description_sources
from launch import logging as logging
from launch import some_entities_type as some_entities_type
from launch import some_substitutions_type as some_substitutions_type
from launch import substitutions as substitutions
from launch import utilities as utilities
from launch.action import Action as Action
from launch.condition import Condition as Condition
from launch.event import Event as Event
from launch.event_handler import EventHandler as EventHandler
from launch.invalid_launch_file_error import InvalidLaunchFileError as InvalidLaunchFileError
from launch.launch_context import LaunchContext as LaunchContext
from launch.launch_description import LaunchDescription as LaunchDescription
from launch.launch_description_entity import LaunchDescriptionEntity as LaunchDescriptionEntity
from launch.launch_description_source import LaunchDescriptionSource as LaunchDescriptionSource
from launch.launch_introspector import LaunchIntrospector as LaunchIntrospector
from launch.launch_service import LaunchService as LaunchService
from launch.some_substitutions_type import SomeSubstitutionsType as SomeSubstitutionsType
from launch.some_substitutions_type import (
    SomeSubstitutionsType_types_tuple as SomeSubstitutionsType_types_tuple,
)
from launch.substitution import Substitution as Substitution
from .some_actions_type import SomeActionsType as SomeActionsType
from .some_actions_type import SomeActionsType_types_tuple as SomeActionsType_types_tuple
