from rclpy.exceptions import NoTypeSupportImportedException as NoTypeSupportImportedException
from typing import Any
from typing import ClassVar, Optional, Protocol, TypeVar
from builtin_interfaces.msg import Time as Time
from service_msgs.msg import ServiceEventInfo as ServiceEventInfo
from typing_extensions import TypeAlias as TypeAlias
from unique_identifier_msgs.msg import UUID as UUID

def check_for_type_support(msg_or_srv_type: Any) -> None: ...
def check_is_valid_msg_type(msg_type: Any) -> None: ...
def check_is_valid_srv_type(srv_type: Any) -> None: ...

class PyCapsule(Protocol): ...

ProtocolType: Any

class CommonMsgSrvMetaClass(ProtocolType):
    _TYPE_SUPPORT: ClassVar[Optional[PyCapsule]]

    @classmethod
    def __import_type_support__(cls) -> None: ...

class MsgMetaClass(CommonMsgSrvMetaClass):
    _CREATE_ROS_MESSAGE: ClassVar[Optional[PyCapsule]]
    _CONVERT_FROM_PY: ClassVar[Optional[PyCapsule]]
    _CONVERT_TO_PY: ClassVar[Optional[PyCapsule]]
    _DESTROY_ROS_MESSAGE: ClassVar[Optional[PyCapsule]]

class Msg(Protocol, metaclass=MsgMetaClass): ...

MsgT = TypeVar("MsgT", bound=Msg)
SrvRequestT = TypeVar("SrvRequestT", bound=Msg)
SrvResponseT = TypeVar("SrvResponseT", bound=Msg)

class EventMessage(Msg, Protocol):
    info: ServiceEventInfo

class Srv(Protocol, metaclass=CommonMsgSrvMetaClass): ...

GoalT = TypeVar("GoalT", bound=Msg)
ResultT = TypeVar("ResultT", bound=Msg)
FeedbackT = TypeVar("FeedbackT", bound=Msg)

class SendGoalServiceRequest(Msg, Protocol[GoalT]):
    goal_id: UUID
    goal: GoalT

class SendGoalServiceResponse(Msg, Protocol):
    accepted: bool
    stamp: Time

SendGoalService: TypeAlias = Srv

class GetResultServiceRequest(Msg, Protocol):
    goal_id: UUID

class GetResultServiceResponse(Msg, Protocol[ResultT]):
    status: int
    result: ResultT

GetResultService: TypeAlias = Srv

class FeedbackMessage(Msg, Protocol[FeedbackT]):
    goal_id: UUID
    feedback: FeedbackT

class Action(Protocol, metaclass=CommonMsgSrvMetaClass): ...

SrvT = TypeVar("SrvT", bound=Srv)
ActionT = TypeVar("ActionT", bound=Action)
