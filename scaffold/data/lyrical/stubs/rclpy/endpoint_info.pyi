from collections.abc import Sequence
from enum import IntEnum
from typing import Annotated
from typing import Any
from typing import Union
from rclpy.qos import (
    QoSHistoryPolicy as QoSHistoryPolicy,
    QoSPresetProfiles as QoSPresetProfiles,
    QoSProfile as QoSProfile,
)
from rclpy.type_hash import TypeHash as TypeHash, TypeHashDictionary as TypeHashDictionary

class EndpointTypeEnum(IntEnum):
    INVALID = 0
    PUBLISHER = 1
    SUBSCRIPTION = 2
    CLIENT = 3
    SERVER = 4

class TopicEndpointInfo:
    def __init__(
        self,
        node_name: str = "",
        node_namespace: str = "",
        topic_type: str = "",
        topic_type_hash: Union[TypeHash, TypeHashDictionary] = ...,
        endpoint_type: Union[EndpointTypeEnum, int] = EndpointTypeEnum.INVALID,
        endpoint_gid: list[int] = ...,
        qos_profile: Union[
            QoSProfile, "_rclpy._rmw_qos_profile_dict"
        ] = QoSPresetProfiles.UNKNOWN.value,
    ) -> None: ...
    @property
    def node_name(self) -> str: ...
    @node_name.setter
    def node_name(self, value: str) -> None: ...
    @property
    def node_namespace(self) -> str: ...
    @node_namespace.setter
    def node_namespace(self, value: str) -> None: ...
    @property
    def topic_type(self) -> str: ...
    @topic_type.setter
    def topic_type(self, value: str) -> None: ...
    @property
    def topic_type_hash(self) -> Annotated[Any, TypeHash]: ...
    @topic_type_hash.setter
    def topic_type_hash(self, value: Union[TypeHash, TypeHashDictionary]) -> None: ...
    @property
    def endpoint_type(self) -> Annotated[Any, EndpointTypeEnum]: ...
    @endpoint_type.setter
    def endpoint_type(self, value: Union[EndpointTypeEnum, int]) -> None: ...
    @property
    def endpoint_gid(self) -> list[int]: ...
    @endpoint_gid.setter
    def endpoint_gid(self, value: list[int]) -> None: ...
    @property
    def qos_profile(self) -> Annotated[Any, QoSProfile]: ...
    @qos_profile.setter
    def qos_profile(self, value: Union[QoSProfile, "_rclpy._rmw_qos_profile_dict"]) -> None: ...
    def __eq__(self, other: object) -> bool: ...
    def __str__(self) -> str: ...
    _node_name: Any
    _node_namespace: Any
    _topic_type: Any
    _topic_type_hash: Any
    _endpoint_type: Any
    _endpoint_gid: Any
    _qos_profile: Any

class ServiceEndpointInfo:
    def __init__(
        self,
        node_name: str = "",
        node_namespace: str = "",
        service_type: str = "",
        service_type_hash: Union[TypeHash, TypeHashDictionary] = ...,
        qos_profiles: Sequence[Union[QoSProfile, "_rclpy._rmw_qos_profile_dict"]] = ...,
        endpoint_gids: list[list[int]] = ...,
        endpoint_type: Union[EndpointTypeEnum, int] = EndpointTypeEnum.INVALID,
        endpoint_count: int = 0,
    ) -> None: ...
    @property
    def node_name(self) -> str: ...
    @node_name.setter
    def node_name(self, value: str) -> None: ...
    @property
    def node_namespace(self) -> str: ...
    @node_namespace.setter
    def node_namespace(self, value: str) -> None: ...
    @property
    def service_type(self) -> str: ...
    @service_type.setter
    def service_type(self, value: str) -> None: ...
    @property
    def service_type_hash(self) -> Annotated[Any, TypeHash]: ...
    @service_type_hash.setter
    def service_type_hash(self, value: Union[TypeHash, TypeHashDictionary]) -> None: ...
    @property
    def endpoint_type(self) -> Annotated[Any, EndpointTypeEnum]: ...
    @endpoint_type.setter
    def endpoint_type(self, value: Union[EndpointTypeEnum, int]) -> None: ...
    @property
    def endpoint_count(self) -> int: ...
    @endpoint_count.setter
    def endpoint_count(self, value: int) -> None: ...
    @property
    def endpoint_gids(self) -> list[list[int]]: ...
    @endpoint_gids.setter
    def endpoint_gids(self, value: list[list[int]]) -> None: ...
    @property
    def qos_profiles(self) -> Annotated[Any, list[QoSProfile]]: ...
    @qos_profiles.setter
    def qos_profiles(
        self, value: list[Union[QoSProfile, "_rclpy._rmw_qos_profile_dict"]]
    ) -> None: ...
    def __eq__(self, other: object) -> bool: ...
    def __str__(self) -> str: ...
    _node_name: Any
    _node_namespace: Any
    _service_type: Any
    _service_type_hash: Any
    _endpoint_type: Any
    _endpoint_count: Any
    _endpoint_gids: Any
    _qos_profiles: Any
