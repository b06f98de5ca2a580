"""The use of rclpy in a file: nodes, publishers, timers, callbacks."""

from __future__ import annotations

from scaffold.model.rclpy.api import (
    GOAL_HANDLE,
    NODE,
    PARAMETER,
    PLACES,
    class_of,
    has,
    is_method,
    known_names,
)
from scaffold.model.rclpy.changed_calls import changed_calls
from scaffold.model.rclpy.changed_names import ChangedUse, changed_uses, is_asked_for, is_tried
from scaffold.model.rclpy.entities import (
    ActionClient,
    ActionServer,
    Argument,
    Callback,
    Client,
    Endpoint,
    Entity,
    Parameter,
    ParameterRead,
    Publisher,
    Service,
    Subscription,
    Synchronizer,
    Timer,
)
from scaffold.model.rclpy.evaluation.attributes import (
    defined_by,
    given_from_outside,
    is_base_elsewhere,
    is_overridden,
    is_read_in_full,
    is_used_elsewhere,
    names_of_bases,
)
from scaffold.model.rclpy.evaluation.named_attributes import read_by_name
from scaffold.model.rclpy.file import RclpyFile, rclpy_file
from scaffold.model.rclpy.files import rclpy_paths
from scaffold.model.rclpy.logging import LOG_METHODS, is_of_rclpy, log_calls
from scaffold.model.rclpy.nodes import NodeClass, NodeDefinition
from scaffold.model.rclpy.parameters.descriptors import DESCRIPTOR, message_made
from scaffold.model.rclpy.parameters.objects import (
    CALLBACKS,
    FIELDS,
    ParameterMade,
    callback_arguments,
    is_listed_parameter,
    is_of_node,
    name_asked,
    names_used_by,
    parameters_set,
)
from scaffold.model.rclpy.running.callbacks import alternatives, numbers_taken, worker
from scaffold.model.rclpy.running.init_and_spin import RclpyCall
from scaffold.model.rclpy.running.stopping import only_while_stopping
from scaffold.model.rclpy.topics.latched import latched_topics
from scaffold.model.rclpy.topics.names import (
    namespace_problem,
    node_problem,
    part_problem,
    topic_problem,
)
from scaffold.model.rclpy.topics.qos import conflict_of
from scaffold.model.rclpy.topics.transforms import (
    CONVERSIONS,
    Lookup,
    buffer_made,
    buffers_in,
    is_spun_by_listener,
    lookups_in,
)

__all__ = [
    "CALLBACKS",
    "CONVERSIONS",
    "DESCRIPTOR",
    "FIELDS",
    "GOAL_HANDLE",
    "LOG_METHODS",
    "NODE",
    "PARAMETER",
    "PLACES",
    "ActionClient",
    "ActionServer",
    "Argument",
    "Callback",
    "ChangedUse",
    "Client",
    "Endpoint",
    "Entity",
    "Lookup",
    "NodeClass",
    "NodeDefinition",
    "Parameter",
    "ParameterMade",
    "ParameterRead",
    "Publisher",
    "RclpyCall",
    "RclpyFile",
    "Service",
    "Subscription",
    "Synchronizer",
    "Timer",
    "alternatives",
    "buffer_made",
    "buffers_in",
    "callback_arguments",
    "changed_calls",
    "changed_uses",
    "class_of",
    "conflict_of",
    "defined_by",
    "given_from_outside",
    "has",
    "is_asked_for",
    "is_base_elsewhere",
    "is_listed_parameter",
    "is_method",
    "is_of_node",
    "is_of_rclpy",
    "is_overridden",
    "is_read_in_full",
    "is_spun_by_listener",
    "is_tried",
    "is_used_elsewhere",
    "known_names",
    "latched_topics",
    "log_calls",
    "lookups_in",
    "message_made",
    "name_asked",
    "names_of_bases",
    "names_used_by",
    "namespace_problem",
    "node_problem",
    "numbers_taken",
    "only_while_stopping",
    "parameters_set",
    "part_problem",
    "rclpy_file",
    "rclpy_paths",
    "read_by_name",
    "topic_problem",
    "worker",
]
