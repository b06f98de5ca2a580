from rclpy import (
    callback_groups as callback_groups,
    client as client,
    clock as clock,
    clock_type as clock_type,
    constants as constants,
    context as context,
    destroyable as destroyable,
    duration as duration,
    event_handler as event_handler,
    exceptions as exceptions,
    executors as executors,
    expand_topic_name as expand_topic_name,
    guard_condition as guard_condition,
    impl as impl,
    lifecycle as lifecycle,
    logging as logging,
    logging_service as logging_service,
    node as node,
    parameter as parameter,
    parameter_service as parameter_service,
    publisher as publisher,
    qos as qos,
    qos_overriding_options as qos_overriding_options,
    service as service,
    service_introspection as service_introspection,
    signals as signals,
    subscription as subscription,
    task as task,
    time as time,
    time_source as time_source,
    timer as timer,
    topic_endpoint_info as topic_endpoint_info,
    type_description_service as type_description_service,
    type_hash as type_hash,
    type_support as type_support,
    utilities as utilities,
    validate_full_topic_name as validate_full_topic_name,
    validate_namespace as validate_namespace,
    validate_node_name as validate_node_name,
    validate_parameter_name as validate_parameter_name,
    validate_topic_name as validate_topic_name,
    waitable as waitable,
)
from typing import Any, List, Optional
from rclpy.executors import Executor
from rclpy.node import Node
from rclpy.task import Future

def spin_once(
    node: Node, *, executor: Optional[Executor] = None, timeout_sec: Optional[float] = None
) -> None: ...
def spin(node: Node, executor: Optional[Executor] = None) -> None: ...
def spin_until_future_complete(
    node: Node,
    future: Future[Any],
    executor: Optional[Executor] = None,
    timeout_sec: Optional[float] = None,
) -> None: ...

del __executor
