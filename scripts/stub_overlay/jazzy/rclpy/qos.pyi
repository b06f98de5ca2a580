from typing import Any, NamedTuple, Union
from typing_extensions import Self

class QoSProfile:
    def __init__(
        self,
        *,
        history: Union[HistoryPolicy, int] = ...,
        depth: int = ...,
        reliability: Union[ReliabilityPolicy, int] = ...,
        durability: Union[DurabilityPolicy, int] = ...,
        lifespan: Duration = ...,
        deadline: Duration = ...,
        liveliness: Union[LivelinessPolicy, int] = ...,
        liveliness_lease_duration: Duration = ...,
        avoid_ros_namespace_conventions: bool = ...,
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
    @property
    def liveliness(self) -> LivelinessPolicy: ...
    @liveliness.setter
    def liveliness(self, value: Union[LivelinessPolicy, int]) -> None: ...
    depth: int
    lifespan: Duration
    deadline: Duration
    liveliness_lease_duration: Duration
    avoid_ros_namespace_conventions: bool
    def get_c_qos_profile(self) -> Any: ...
    def __eq__(self, other: object) -> bool: ...
    def __str__(self) -> str: ...

# An enumeration of its own has no members, which type checkers refuse.
class QoSPolicyEnum(object):
    @classmethod
    def short_keys(cls) -> list[str]: ...
    @classmethod
    def get_from_short_key(cls, name: str) -> Self: ...
    @property
    def short_key(self) -> str: ...

class HistoryPolicy(QoSPolicyEnum, IntEnum):
    RMW_QOS_POLICY_HISTORY_SYSTEM_DEFAULT = SYSTEM_DEFAULT
    RMW_QOS_POLICY_HISTORY_KEEP_LAST = KEEP_LAST
    RMW_QOS_POLICY_HISTORY_KEEP_ALL = KEEP_ALL
    RMW_QOS_POLICY_HISTORY_UNKNOWN = UNKNOWN

class ReliabilityPolicy(QoSPolicyEnum, IntEnum):
    RMW_QOS_POLICY_RELIABILITY_SYSTEM_DEFAULT = SYSTEM_DEFAULT
    RMW_QOS_POLICY_RELIABILITY_RELIABLE = RELIABLE
    RMW_QOS_POLICY_RELIABILITY_BEST_EFFORT = BEST_EFFORT
    RMW_QOS_POLICY_RELIABILITY_UNKNOWN = UNKNOWN

class DurabilityPolicy(QoSPolicyEnum, IntEnum):
    RMW_QOS_POLICY_DURABILITY_SYSTEM_DEFAULT = SYSTEM_DEFAULT
    RMW_QOS_POLICY_DURABILITY_TRANSIENT_LOCAL = TRANSIENT_LOCAL
    RMW_QOS_POLICY_DURABILITY_VOLATILE = VOLATILE
    RMW_QOS_POLICY_DURABILITY_UNKNOWN = UNKNOWN

class LivelinessPolicy(QoSPolicyEnum, IntEnum):
    RMW_QOS_POLICY_LIVELINESS_SYSTEM_DEFAULT = SYSTEM_DEFAULT
    RMW_QOS_POLICY_LIVELINESS_AUTOMATIC = AUTOMATIC
    RMW_QOS_POLICY_LIVELINESS_MANUAL_BY_TOPIC = MANUAL_BY_TOPIC
    RMW_QOS_POLICY_LIVELINESS_UNKNOWN = UNKNOWN

class QoSPresetProfiles(Enum):
    @property
    def value(self) -> QoSProfile: ...
    @classmethod
    def short_keys(cls) -> list[str]: ...
    @classmethod
    def get_from_short_key(cls, name: str) -> QoSProfile: ...

class QoSCompatibility(Enum):
    OK = 0
    WARNING = 1
    ERROR = 2

def qos_policy_name_from_kind(policy_kind: Union[QoSPolicyKind, int]) -> str: ...
def qos_check_compatible(
    publisher_qos: QoSProfile, subscription_qos: QoSProfile
) -> tuple[QoSCompatibility, str]: ...
