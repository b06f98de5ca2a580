from typing import Any
from typing import Callable
from typing import Iterable
from typing import Optional
from typing import Text
from typing import Union
from rcl_interfaces.msg import ParameterDescriptor as ParameterDescriptor
from rcl_interfaces.msg import SetParametersResult as SetParametersResult
from rclpy.duration import Duration as Duration
from rclpy.exceptions import ParameterAlreadyDeclaredException as ParameterAlreadyDeclaredException
from rclpy.parameter import Parameter as Parameter
from rclpy.publisher import Publisher as Publisher
from rclpy.qos import QoSDurabilityPolicy as QoSDurabilityPolicy
from rclpy.qos import QoSHistoryPolicy as QoSHistoryPolicy
from rclpy.qos import QoSLivelinessPolicy as QoSLivelinessPolicy
from rclpy.qos import QoSPolicyKind as QoSPolicyKind
from rclpy.qos import QoSProfile as QoSProfile
from rclpy.qos import QoSReliabilityPolicy as QoSReliabilityPolicy
from rclpy.subscription import Subscription as Subscription
from typing import TypeAlias
from rclpy.node import Node as Node

class InvalidQosOverridesError(Exception): ...

QosCallbackResult: TypeAlias = SetParametersResult
QosCallbackType = Callable[[QoSProfile], QosCallbackResult]

class QoSOverridingOptions:
    def __init__(
        self,
        policy_kinds: Iterable[QoSPolicyKind],
        *,
        callback: Optional[QosCallbackType] = None,
        entity_id: Optional[Text] = None,
    ) -> None: ...
    @property
    def policy_kinds(self) -> Iterable[QoSPolicyKind]: ...
    @property
    def callback(self) -> Optional[QosCallbackType]: ...
    @property
    def entity_id(self) -> Optional[Text]: ...
    @classmethod
    def with_default_policies(
        cls, *, callback: Optional[QosCallbackType] = None, entity_id: Optional[Text] = None
    ) -> QoSOverridingOptions: ...
    _policy_kinds: Any
    _callback: Any
    _entity_id: Any

QoSProfileAttributes = Union[
    QoSHistoryPolicy,
    int,
    QoSReliabilityPolicy,
    QoSDurabilityPolicy,
    Duration,
    QoSLivelinessPolicy,
    bool,
]
