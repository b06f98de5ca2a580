from enum import Enum
from enum import IntEnum
from typing import Union
from rclpy.duration import Duration as Duration
from typing import Any
from typing_extensions import Self
from typing import TypeVar
from typing_extensions import TypeAlias as TypeAlias

class QoSPolicyKind(IntEnum):
    INVALID = ...
    DURABILITY = ...
    DEADLINE = ...
    LIVELINESS = ...
    RELIABILITY = ...
    HISTORY = ...
    LIFESPAN = ...
    DEPTH = ...
    LIVELINESS_LEASE_DURATION = ...
    AVOID_ROS_NAMESPACE_CONVENTIONS = ...

def qos_policy_name_from_kind(policy_kind: Union[QoSPolicyKind, int]) -> str: ...

class InvalidQoSProfileException(Exception):
    def __init__(self, message: str) -> None: ...

class QoSProfile:
    __qos_profile_default_dict: Any

    def __init__(
        self,
        history: Union[HistoryPolicy, int] = None,
        depth: int = None,
        reliability: Union[ReliabilityPolicy, int] = None,
        durability: Union[DurabilityPolicy, int] = None,
        lifespan: Duration = None,
        deadline: Duration = None,
        liveliness: Union[LivelinessPolicy, int] = None,
        liveliness_lease_duration: Duration = None,
        avoid_ros_namespace_conventions: bool = None,
    ) -> None: ...
    @property
    def history(self) -> HistoryPolicy: ...
    @history.setter
    def history(self, value: Union[HistoryPolicy, int]) -> None: ...
    @property
    def reliability(self) -> ReliabilityPolicy: ...
    @reliability.setter
    def reliability(self, value: Union[ReliabilityPolicy, int]) -> None: ...
    @property
    def durability(self) -> DurabilityPolicy: ...
    @durability.setter
    def durability(self, value: Union[DurabilityPolicy, int]) -> None: ...
    depth: int
    lifespan: Duration
    deadline: Duration

    @property
    def liveliness(self) -> LivelinessPolicy: ...
    @liveliness.setter
    def liveliness(self, value: Union[LivelinessPolicy, int]) -> None: ...
    liveliness_lease_duration: Duration
    avoid_ros_namespace_conventions: bool

    def get_c_qos_profile(self) -> Any: ...
    def __eq__(self, other: object) -> bool: ...
    def __str__(self) -> str: ...
    _history: Any
    _reliability: Any
    _durability: Any
    _depth: Any
    _lifespan: Any
    _deadline: Any
    _liveliness: Any
    _liveliness_lease_duration: Any
    _avoid_ros_namespace_conventions: Any

class QoSPolicyEnum(object):
    @classmethod
    def short_keys(cls) -> list[str]: ...
    @classmethod
    def get_from_short_key(cls, name: str) -> Self: ...
    @property
    def short_key(self) -> str: ...

class HistoryPolicy(QoSPolicyEnum, IntEnum):
    SYSTEM_DEFAULT = 0
    KEEP_LAST = 1
    KEEP_ALL = 2
    UNKNOWN = 3
    RMW_QOS_POLICY_HISTORY_SYSTEM_DEFAULT = SYSTEM_DEFAULT
    RMW_QOS_POLICY_HISTORY_KEEP_LAST = KEEP_LAST
    RMW_QOS_POLICY_HISTORY_KEEP_ALL = KEEP_ALL
    RMW_QOS_POLICY_HISTORY_UNKNOWN = UNKNOWN

QoSHistoryPolicy: TypeAlias = HistoryPolicy

class ReliabilityPolicy(QoSPolicyEnum, IntEnum):
    SYSTEM_DEFAULT = 0
    RELIABLE = 1
    BEST_EFFORT = 2
    UNKNOWN = 3
    BEST_AVAILABLE = 4
    RMW_QOS_POLICY_RELIABILITY_SYSTEM_DEFAULT = SYSTEM_DEFAULT
    RMW_QOS_POLICY_RELIABILITY_RELIABLE = RELIABLE
    RMW_QOS_POLICY_RELIABILITY_BEST_EFFORT = BEST_EFFORT
    RMW_QOS_POLICY_RELIABILITY_UNKNOWN = UNKNOWN

QoSReliabilityPolicy: TypeAlias = ReliabilityPolicy

class DurabilityPolicy(QoSPolicyEnum, IntEnum):
    SYSTEM_DEFAULT = 0
    TRANSIENT_LOCAL = 1
    VOLATILE = 2
    UNKNOWN = 3
    BEST_AVAILABLE = 4
    RMW_QOS_POLICY_DURABILITY_SYSTEM_DEFAULT = SYSTEM_DEFAULT
    RMW_QOS_POLICY_DURABILITY_TRANSIENT_LOCAL = TRANSIENT_LOCAL
    RMW_QOS_POLICY_DURABILITY_VOLATILE = VOLATILE
    RMW_QOS_POLICY_DURABILITY_UNKNOWN = UNKNOWN

QoSDurabilityPolicy: TypeAlias = DurabilityPolicy

class LivelinessPolicy(QoSPolicyEnum, IntEnum):
    SYSTEM_DEFAULT = 0
    AUTOMATIC = 1
    MANUAL_BY_TOPIC = 3
    UNKNOWN = 4
    BEST_AVAILABLE = 5
    RMW_QOS_POLICY_LIVELINESS_SYSTEM_DEFAULT = SYSTEM_DEFAULT
    RMW_QOS_POLICY_LIVELINESS_AUTOMATIC = AUTOMATIC
    RMW_QOS_POLICY_LIVELINESS_MANUAL_BY_TOPIC = MANUAL_BY_TOPIC
    RMW_QOS_POLICY_LIVELINESS_UNKNOWN = UNKNOWN

QoSLivelinessPolicy: TypeAlias = LivelinessPolicy
DeadlineBestAvailable: Duration
LivelinessLeaseDurationeBestAvailable: Duration
qos_profile_unknown: QoSProfile
qos_profile_default: QoSProfile
qos_profile_system_default: QoSProfile
qos_profile_sensor_data: QoSProfile
qos_profile_services_default: QoSProfile
qos_profile_parameters: QoSProfile
qos_profile_parameter_events: QoSProfile
qos_profile_best_available: QoSProfile
qos_profile_action_status_default: QoSProfile

class QoSPresetProfiles(Enum):
    UNKNOWN = ...
    DEFAULT = ...
    SYSTEM_DEFAULT = ...
    SENSOR_DATA = ...
    SERVICES_DEFAULT = ...
    PARAMETERS = ...
    PARAMETER_EVENTS = ...
    ACTION_STATUS_DEFAULT = ...
    BEST_AVAILABLE = ...

    @classmethod
    def short_keys(cls) -> list[str]: ...
    @classmethod
    def get_from_short_key(cls, name: str) -> QoSProfile: ...
    @property
    def value(self) -> QoSProfile: ...
    ROSOUT_DEFAULT = ...

class QoSCompatibility(Enum):
    OK = 0
    WARNING = 1
    ERROR = 2

def qos_check_compatible(
    publisher_qos: QoSProfile, subscription_qos: QoSProfile
) -> tuple[QoSCompatibility, str]: ...

_T = TypeVar("_T", bound=QoSPolicyEnum)
qos_profile_rosout_default: QoSProfile
