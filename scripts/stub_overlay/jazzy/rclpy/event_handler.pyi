from enum import Enum
from typing import Any

class QoSPublisherEventType(Enum):
    RCL_PUBLISHER_OFFERED_DEADLINE_MISSED = ...
    RCL_PUBLISHER_LIVELINESS_LOST = ...
    RCL_PUBLISHER_OFFERED_INCOMPATIBLE_QOS = ...
    RCL_PUBLISHER_INCOMPATIBLE_TYPE = ...
    RCL_PUBLISHER_MATCHED = ...

class QoSSubscriptionEventType(Enum):
    RCL_SUBSCRIPTION_REQUESTED_DEADLINE_MISSED = ...
    RCL_SUBSCRIPTION_LIVELINESS_CHANGED = ...
    RCL_SUBSCRIPTION_REQUESTED_INCOMPATIBLE_QOS = ...
    RCL_SUBSCRIPTION_MESSAGE_LOST = ...
    RCL_SUBSCRIPTION_INCOMPATIBLE_TYPE = ...
    RCL_SUBSCRIPTION_MATCHED = ...

class QoSRequestedDeadlineMissedInfo:
    total_count: int
    total_count_change: int

class QoSLivelinessChangedInfo:
    alive_count: int
    not_alive_count: int
    alive_count_change: int
    not_alive_count_change: int

class QoSMessageLostInfo:
    total_count: int
    total_count_change: int

class QoSRequestedIncompatibleQoSInfo:
    total_count: int
    total_count_change: int
    last_policy_kind: Any

class QoSSubscriptionMatchedInfo:
    total_count: int
    total_count_change: int
    current_count: int
    current_count_change: int

class QoSOfferedDeadlineMissedInfo:
    total_count: int
    total_count_change: int

class QoSLivelinessLostInfo:
    total_count: int
    total_count_change: int

QoSPublisherMatchedInfo = QoSSubscriptionMatchedInfo

class IncompatibleTypeInfo:
    total_count_change: int

class UnsupportedEventTypeError(RuntimeError): ...

class SubscriptionEventCallbacks:
    def __init__(
        self,
        *,
        deadline: Optional[Callable[[QoSRequestedDeadlineMissedInfo], object]] = None,
        incompatible_qos: Optional[Callable[[QoSRequestedIncompatibleQoSInfo], object]] = None,
        liveliness: Optional[Callable[[QoSLivelinessChangedInfo], object]] = None,
        message_lost: Optional[Callable[[QoSMessageLostInfo], object]] = None,
        incompatible_type: Optional[Callable[[IncompatibleTypeInfo], object]] = None,
        matched: Optional[Callable[[QoSSubscriptionMatchedInfo], object]] = None,
        use_default_callbacks: bool = True,
    ) -> None: ...

class PublisherEventCallbacks:
    def __init__(
        self,
        *,
        deadline: Optional[Callable[[QoSOfferedDeadlineMissedInfo], object]] = None,
        liveliness: Optional[Callable[[QoSLivelinessLostInfo], object]] = None,
        incompatible_qos: Optional[Callable[[QoSRequestedIncompatibleQoSInfo], object]] = None,
        incompatible_type: Optional[Callable[[IncompatibleTypeInfo], object]] = None,
        matched: Optional[Callable[[QoSPublisherMatchedInfo], object]] = None,
        use_default_callbacks: bool = True,
    ) -> None: ...
