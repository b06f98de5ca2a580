from collections.abc import Awaitable, Callable
from typing import Any, Generic, Optional
from _ros_interfaces import Action, FeedbackT, GoalT, ResultT
from action_msgs.msg import GoalInfo as GoalInfo
from rclpy.callback_groups import CallbackGroup
from rclpy.node import Node
from rclpy.qos import QoSProfile as QoSProfile
from unique_identifier_msgs.msg import UUID as UUID

class RCLError(RuntimeError): ...

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
    def execute(
        self,
        execute_callback: Optional[
            Callable[[ServerGoalHandle[GoalT, ResultT, FeedbackT]], ResultT | Awaitable[ResultT]]
        ] = None,
    ) -> None: ...
    def publish_feedback(self, feedback: FeedbackT) -> None: ...

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
    @property
    def action_type(self) -> type[Action[GoalT, ResultT, FeedbackT]]: ...
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
        self,
        cancel_callback: Optional[Callable[[Any], CancelResponse | Awaitable[CancelResponse]]],
    ) -> None: ...
    def register_execute_callback(
        self,
        execute_callback: Callable[
            [ServerGoalHandle[GoalT, ResultT, FeedbackT]], ResultT | Awaitable[ResultT]
        ],
    ) -> None: ...
