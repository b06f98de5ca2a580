from collections.abc import Awaitable, Callable
from typing import Any, Generic, Optional
from _ros_interfaces import Action, FeedbackT, GoalT, ResultT
from action_msgs.srv import CancelGoal as CancelGoal
from builtin_interfaces.msg import Time
from rclpy.callback_groups import CallbackGroup
from rclpy.node import Node
from rclpy.qos import QoSProfile as QoSProfile
from rclpy.task import Future as Future
from unique_identifier_msgs.msg import UUID as UUID

class _GetResultResponse(Generic[ResultT]):
    status: int
    result: ResultT

class ClientGoalHandle(Generic[GoalT, ResultT, FeedbackT]):
    def __init__(self, action_client: Any, goal_id: UUID, goal_response: Any) -> None: ...
    def __eq__(self, other: object) -> bool: ...
    def __ne__(self, other: object) -> bool: ...
    def __repr__(self) -> str: ...
    @property
    def goal_id(self) -> UUID: ...
    @property
    def stamp(self) -> Time: ...
    @property
    def accepted(self) -> bool: ...
    @property
    def status(self) -> int: ...
    def cancel_goal(self) -> CancelGoal.Response: ...
    def cancel_goal_async(self) -> Future[CancelGoal.Response]: ...
    def get_result(self) -> _GetResultResponse[ResultT]: ...
    def get_result_async(self) -> Future[_GetResultResponse[ResultT]]: ...

class ActionClient(Waitable, Generic[GoalT, ResultT, FeedbackT]):
    def __init__(
        self,
        node: Node,
        action_type: type[Action[GoalT, ResultT, FeedbackT]],
        action_name: str,
        *,
        callback_group: Optional[CallbackGroup] = None,
        goal_service_qos_profile: QoSProfile = ...,
        result_service_qos_profile: QoSProfile = ...,
        cancel_service_qos_profile: QoSProfile = ...,
        feedback_sub_qos_profile: QoSProfile = ...,
        status_sub_qos_profile: QoSProfile = ...,
    ) -> None: ...
    def send_goal(
        self,
        goal: GoalT,
        *,
        feedback_callback: Optional[Callable[[Any], object]] = None,
        goal_uuid: Optional[UUID] = None,
    ) -> _GetResultResponse[ResultT]: ...
    def send_goal_async(
        self,
        goal: GoalT,
        feedback_callback: Optional[Callable[[Any], object]] = None,
        goal_uuid: Optional[UUID] = None,
    ) -> Future[ClientGoalHandle[GoalT, ResultT, FeedbackT]]: ...
    def server_is_ready(self) -> bool: ...
    def wait_for_server(self, timeout_sec: Optional[float] = None) -> bool: ...
