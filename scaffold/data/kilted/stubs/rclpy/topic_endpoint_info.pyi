from typing import Any
from enum import IntEnum
from rclpy.qos import (
    QoSHistoryPolicy as QoSHistoryPolicy,
    QoSPresetProfiles as QoSPresetProfiles,
    QoSProfile as QoSProfile,
)
from rclpy.type_hash import TypeHash as TypeHash
from typing import List, Union
from rclpy.type_hash import TypeHashDictionary as TypeHashDictionary

class TopicEndpointTypeEnum(IntEnum):
    INVALID = 0
    PUBLISHER = 1
    SUBSCRIPTION = 2

class TopicEndpointInfo:
    def __init__(
        self,
        node_name: str = "",
        node_namespace: str = "",
        topic_type: str = "",
        topic_type_hash: Union[TypeHash, TypeHashDictionary] = ...,
        endpoint_type: Union[TopicEndpointTypeEnum, int] = TopicEndpointTypeEnum.INVALID,
        endpoint_gid: List[int] = ...,
        qos_profile: Union[
            QoSProfile, "_rclpy._rmw_qos_profile_dict"
        ] = QoSPresetProfiles.UNKNOWN.value,
    ) -> None: ...
    node_name: str
    node_namespace: str
    topic_type: str
    topic_type_hash: TypeHash
    endpoint_type: TopicEndpointTypeEnum
    endpoint_gid: list[int]
    qos_profile: QoSProfile

    def __eq__(self, other: object) -> bool: ...
    def __str__(self) -> str: ...
    _node_name: Any
    _node_namespace: Any
    _topic_type: Any
    _topic_type_hash: Any
    _endpoint_type: Any
    _endpoint_gid: Any
    _qos_profile: Any
