from typing import Any
from enum import IntEnum
from rclpy.qos import (
    QoSHistoryPolicy as QoSHistoryPolicy,
    QoSPresetProfiles as QoSPresetProfiles,
    QoSProfile as QoSProfile,
)

class TopicEndpointTypeEnum(IntEnum):
    INVALID = 0
    PUBLISHER = 1
    SUBSCRIPTION = 2

class TopicEndpointInfo:
    def __init__(self, **kwargs: Any) -> None: ...
    node_name: str
    node_namespace: str
    topic_type: str
    endpoint_type: TopicEndpointTypeEnum
    endpoint_gid: list[int]
    qos_profile: QoSProfile

    def __eq__(self, other: object) -> bool: ...
    def __str__(self) -> str: ...
    _node_name: Any
    _node_namespace: Any
    _topic_type: Any
    _endpoint_type: Any
    _endpoint_gid: Any
    _qos_profile: Any
