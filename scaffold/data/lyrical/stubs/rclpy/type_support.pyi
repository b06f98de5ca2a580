from rclpy.exceptions import NoTypeSupportImportedException as NoTypeSupportImportedException
from typing import Any
from typing import Generic
from typing import TypeVar
from builtin_interfaces.msg import Time as Time
from rosidl_pycommon.interface_base_classes import BaseAction as BaseAction
from rosidl_pycommon.interface_base_classes import BaseImpl as BaseImpl
from rosidl_pycommon.interface_base_classes import BaseMessage as BaseMessage
from rosidl_pycommon.interface_base_classes import BaseService as BaseService
from service_msgs.msg import ServiceEventInfo as ServiceEventInfo
from typing_extensions import TypeAlias as TypeAlias
from unique_identifier_msgs.msg import UUID as UUID

def check_for_type_support(msg_or_srv_type: Any) -> None: ...
def check_is_valid_msg_type(msg_type: Any) -> None: ...
def check_is_valid_srv_type(srv_type: Any) -> None: ...

Msg: TypeAlias = BaseMessage
MsgT = TypeVar("MsgT", bound=BaseMessage)
SrvRequestT = TypeVar("SrvRequestT", bound=BaseMessage)
SrvResponseT = TypeVar("SrvResponseT", bound=BaseMessage)

class EventMessage(BaseMessage):
    info: ServiceEventInfo

Srv: TypeAlias = BaseService[SrvRequestT, SrvResponseT]
GoalT = TypeVar("GoalT", bound=BaseMessage)
ResultT = TypeVar("ResultT", bound=BaseMessage)
FeedbackT = TypeVar("FeedbackT", bound=BaseMessage)
ImplT = TypeVar("ImplT", bound=BaseImpl[Any, Any, Any])

class SendGoalServiceRequest(BaseMessage, Generic[GoalT]):
    goal_id: UUID
    goal: GoalT

class SendGoalServiceResponse(BaseMessage):
    accepted: bool
    stamp: Time

SendGoalService: TypeAlias = BaseService[Any, Any]

class GetResultServiceRequest(BaseMessage):
    goal_id: UUID

class GetResultServiceResponse(BaseMessage, Generic[ResultT]):
    status: int
    result: ResultT

GetResultService: TypeAlias = BaseService[Any, Any]

class FeedbackMessage(BaseMessage, Generic[FeedbackT]):
    goal_id: UUID
    feedback: FeedbackT

Action: TypeAlias = BaseAction[GoalT, ResultT, FeedbackT, ImplT]
SrvT = TypeVar("SrvT", bound=BaseService[Any, Any])
ActionT = TypeVar("ActionT", bound=BaseAction[Any, Any, Any, Any])
