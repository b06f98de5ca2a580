from action_msgs.msg import GoalStatus as GoalStatus
from action_msgs.srv import CancelGoal as CancelGoal
from rclpy.executors import await_or_execute as await_or_execute
from rclpy.qos import qos_profile_action_status_default as qos_profile_action_status_default
from rclpy.qos import qos_profile_services_default as qos_profile_services_default
from rclpy.qos import QoSProfile as QoSProfile
from rclpy.task import Future as Future
from rclpy.type_support import check_for_type_support as check_for_type_support
from rclpy.waitable import NumberOfEntities as NumberOfEntities, Waitable as Waitable
from unique_identifier_msgs.msg import UUID as UUID
from collections.abc import Callable
from typing import Any, Generic, Optional
from _ros_interfaces import Action, FeedbackT, GoalT, ResultT
from builtin_interfaces.msg import Time
from rclpy.callback_groups import CallbackGroup
from rclpy.node import Node
from typing import Coroutine
from typing import Tuple
from typing import TypedDict
from typing import TypeVar
from typing import Union
from action_msgs.msg._goal_status_array import GoalStatusArray as GoalStatusArray
from rclpy.clock import Clock as Clock
from rclpy.service_introspection import ServiceIntrospectionState as ServiceIntrospectionState
from rclpy.type_support import FeedbackMessage as FeedbackMessage
from rclpy.type_support import GetResultServiceResponse as GetResultServiceResponse
from rclpy.type_support import ImplT as ImplT
from rclpy.type_support import Msg as Msg
from rclpy.type_support import SendGoalServiceResponse as SendGoalServiceResponse
from typing_extensions import TypeAlias as TypeAlias, Unpack as Unpack

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
    _action_client: Any
    _goal_id: Any
    _goal_response: Any
    _status: Any

class ActionClient(Waitable, Generic[GoalT, ResultT, FeedbackT]):
    def __init__(
        self,
        node: Node,
        action_type: type[Action[GoalT, ResultT, FeedbackT]],
        action_name: str,
        *,
        callback_group: Optional[CallbackGroup] = None,
        goal_service_qos_profile: QoSProfile = qos_profile_services_default,
        result_service_qos_profile: QoSProfile = qos_profile_services_default,
        cancel_service_qos_profile: QoSProfile = qos_profile_services_default,
        feedback_sub_qos_profile: QoSProfile = ...,
        status_sub_qos_profile: QoSProfile = qos_profile_action_status_default,
        enable_feedback_msg_optimization: bool = False,
    ) -> None: ...
    _generate_random_uuid: Any
    _remove_pending_request: Any
    _remove_pending_goal_request: Any
    _remove_pending_cancel_request: Any
    _remove_pending_result_request: Any

    def is_ready(self, wait_set: Any) -> Any: ...
    def take_data(self) -> Any: ...
    async def execute(self, taken_data: Any) -> None: ...
    def get_num_entities(self) -> Any: ...
    def add_to_wait_set(self, wait_set: Any) -> None: ...
    def __enter__(self) -> None: ...
    def __exit__(self, t: Any, v: Any, tb: Any) -> None: ...
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
    _cancel_goal: Any
    _cancel_goal_async: Any
    _get_result: Any
    _get_result_async: Any

    def server_is_ready(self) -> bool: ...
    def wait_for_server(self, timeout_sec: Optional[float] = None) -> bool: ...
    def destroy(self) -> None: ...
    _node: Any
    _action_type: Any
    _action_name: Any
    _is_ready: Any
    _goal_handles: Any
    _pending_goal_requests: Any
    _goal_sequence_number_to_goal_id: Any
    _pending_cancel_requests: Any
    _pending_result_requests: Any
    _result_sequence_number_to_goal_id: Any
    _feedback_callbacks: Any
    _logger: Any
    _client_handle: Any
    _is_feedback_ready: Any
    _is_status_ready: Any
    _is_goal_response_ready: Any
    _is_cancel_response_ready: Any
    _is_result_response_ready: Any

    def configure_introspection(
        self,
        clock: Clock,
        service_event_qos_profile: QoSProfile,
        introspection_state: ServiceIntrospectionState,
    ) -> None: ...
    _enable_feedback_msg_optimization: Any

class _GetResultResponse(Generic[ResultT]):
    status: int
    result: ResultT

ClientGoalHandleDictResultT = TypeVar("ClientGoalHandleDictResultT", bound=Msg)
ClientGoalHandleDictFeedbackT = TypeVar("ClientGoalHandleDictFeedbackT", bound=Msg)

class ClientGoalHandleDict(
    TypedDict, Generic[ClientGoalHandleDictResultT, ClientGoalHandleDictFeedbackT], total=False
):
    goal: Tuple[int, SendGoalServiceResponse]
    cancel: Tuple[int, CancelGoal.Response]
    result: Tuple[int, GetResultServiceResponse[ClientGoalHandleDictResultT]]
    feedback: FeedbackMessage[ClientGoalHandleDictFeedbackT]
    status: GoalStatusArray

FeedbackCallbackUnion: TypeAlias = Union[
    Callable[[FeedbackMessage[FeedbackT]], None],
    Callable[[FeedbackMessage[FeedbackT]], Coroutine[Any, Any, None]],
]

class SendGoalKWargs(TypedDict, Generic[FeedbackT]):
    feedback_callback: Optional[FeedbackCallbackUnion[FeedbackT]]
    goal_uuid: Optional[UUID]

T = TypeVar("T")
RCLError: Any
