from enum import Enum
from action_msgs.msg import GoalInfo as GoalInfo, GoalStatus as GoalStatus
from rclpy.executors import await_or_execute as await_or_execute
from rclpy.qos import qos_profile_action_status_default as qos_profile_action_status_default
from rclpy.qos import qos_profile_services_default as qos_profile_services_default
from rclpy.qos import QoSProfile as QoSProfile
from rclpy.task import Future as Future
from rclpy.type_support import check_for_type_support as check_for_type_support
from rclpy.waitable import NumberOfEntities as NumberOfEntities, Waitable as Waitable
from collections.abc import Awaitable, Callable
from typing import Any, Generic, Optional
from _ros_interfaces import Action, FeedbackT, GoalT, ResultT
from rclpy.callback_groups import CallbackGroup
from rclpy.node import Node
from unique_identifier_msgs.msg import UUID as UUID
from typing import Tuple, TypedDict, TypeVar
from action_msgs.srv._cancel_goal import CancelGoal as CancelGoal
from rclpy.clock import Clock as Clock
from rclpy.service_introspection import ServiceIntrospectionState as ServiceIntrospectionState
from rclpy.task import Task as Task
from rclpy.type_support import (
    FeedbackMessage as FeedbackMessage,
    GetResultServiceRequest as GetResultServiceRequest,
    GetResultServiceResponse as GetResultServiceResponse,
    SendGoalServiceRequest as SendGoalServiceRequest,
)
from typing_extensions import TypeAlias as TypeAlias

class RCLError(RuntimeError): ...

class GoalResponse(Enum):
    REJECT = 1
    ACCEPT = 2

class CancelResponse(Enum):
    REJECT = 1
    ACCEPT = 2

class GoalEvent(Enum):
    EXECUTE = ...
    CANCEL_GOAL = ...
    SUCCEED = ...
    ABORT = ...
    CANCELED = ...

class ServerGoalHandle(Generic[GoalT, ResultT, FeedbackT]):
    def __init__(self, action_server: Any, goal_info: GoalInfo, goal_request: GoalT) -> None: ...
    def __eq__(self, other: object) -> bool: ...
    def __ne__(self, other: object) -> bool: ...
    @property
    def request(self) -> GoalT: ...
    @property
    def goal_id(self) -> UUID: ...
    @property
    def is_active(self) -> bool: ...
    @property
    def is_cancel_requested(self) -> bool: ...
    @property
    def status(self) -> int: ...
    _update_state: Any

    def execute(
        self,
        execute_callback: Optional[
            Callable[[ServerGoalHandle[GoalT, ResultT, FeedbackT]], ResultT | Awaitable[ResultT]]
        ] = None,
    ) -> None: ...
    def publish_feedback(self, feedback: FeedbackT) -> None: ...
    def succeed(self) -> None: ...
    def abort(self) -> None: ...
    def canceled(self) -> None: ...
    def destroy(self) -> None: ...
    _goal_handle: Any
    _action_server: Any
    _goal_info: Any
    _goal_request: Any
    _cancel_requested: Any
    _lock: Any

def default_handle_accepted_callback(goal_handle: ServerGoalHandle) -> None: ...
def default_goal_callback(goal_request: Any) -> GoalResponse: ...
def default_cancel_callback(cancel_request: Any) -> CancelResponse: ...

class ActionServer(Waitable, Generic[GoalT, ResultT, FeedbackT]):
    def __init__(
        self,
        node: Node,
        action_type: type[Action[GoalT, ResultT, FeedbackT]],
        action_name: str,
        execute_callback: Callable[
            [ServerGoalHandle[GoalT, ResultT, FeedbackT]], ResultT | Awaitable[ResultT]
        ],
        *,
        callback_group: Optional[CallbackGroup] = None,
        goal_callback: Callable[[GoalT], GoalResponse | Awaitable[GoalResponse]] = ...,
        handle_accepted_callback: Callable[
            [ServerGoalHandle[GoalT, ResultT, FeedbackT]], object
        ] = ...,
        cancel_callback: Callable[[Any], CancelResponse | Awaitable[CancelResponse]] = ...,
        goal_service_qos_profile: QoSProfile = ...,
        result_service_qos_profile: QoSProfile = ...,
        cancel_service_qos_profile: QoSProfile = ...,
        feedback_pub_qos_profile: QoSProfile = ...,
        status_pub_qos_profile: QoSProfile = ...,
        result_timeout: int = 900,
    ) -> None: ...
    _execute_goal_request: Any
    _execute_goal: Any
    _execute_cancel_request: Any
    _execute_get_result_request: Any
    _execute_expire_goals: Any
    _send_result_response: Any

    @property
    def action_type(self) -> type[Action[GoalT, ResultT, FeedbackT]]: ...
    def is_ready(self, wait_set: Any) -> Any: ...
    def take_data(self) -> Any: ...
    async def execute(self, taken_data: Any) -> None: ...
    def get_num_entities(self) -> Any: ...
    def add_to_wait_set(self, wait_set: Any) -> None: ...
    def __enter__(self) -> None: ...
    def __exit__(self, t: Any, v: Any, tb: Any) -> None: ...
    def notify_execute(self, goal_handle: Any, execute_callback: Any) -> None: ...
    def notify_goal_done(self) -> None: ...
    def register_handle_accepted_callback(
        self,
        handle_accepted_callback: Optional[
            Callable[[ServerGoalHandle[GoalT, ResultT, FeedbackT]], object]
        ],
    ) -> None: ...
    def register_goal_callback(
        self, goal_callback: Optional[Callable[[GoalT], GoalResponse | Awaitable[GoalResponse]]]
    ) -> None: ...
    def register_cancel_callback(
        self, cancel_callback: Optional[Callable[[Any], CancelResponse | Awaitable[CancelResponse]]]
    ) -> None: ...
    def register_execute_callback(
        self,
        execute_callback: Callable[
            [ServerGoalHandle[GoalT, ResultT, FeedbackT]], ResultT | Awaitable[ResultT]
        ],
    ) -> None: ...
    def destroy(self) -> None: ...
    _lock: Any
    _node: Any
    _action_type: Any
    _goal_handles: Any
    _result_futures: Any
    _logger: Any
    _handle: Any
    _is_goal_request_ready: Any
    _is_cancel_request_ready: Any
    _is_result_request_ready: Any
    _is_goal_expired: Any
    _handle_accepted_callback: Any
    _goal_callback: Any
    _cancel_callback: Any
    _execute_callback: Any

    def configure_introspection(
        self,
        clock: Clock,
        service_event_qos_profile: QoSProfile,
        introspection_state: ServiceIntrospectionState,
    ) -> None: ...

ServerGoalHandleDictGoalT = TypeVar("ServerGoalHandleDictGoalT")

class ServerGoalHandleDict(TypedDict, Generic[ServerGoalHandleDictGoalT], total=False):
    goal: Tuple["_rclpy.rmw_request_id_t", SendGoalServiceRequest[ServerGoalHandleDictGoalT]]
    cancel: Tuple["_rclpy.rmw_request_id_t", CancelGoal.Request]
    result: Tuple["_rclpy.rmw_request_id_t", GetResultServiceRequest]
    expired: Tuple[GoalInfo, ...]
