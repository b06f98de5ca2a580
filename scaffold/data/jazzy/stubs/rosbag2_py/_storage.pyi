import datetime
from enum import IntEnum
from typing import Any

from rclpy.duration import Duration as _Duration
from rclpy.qos import QoSProfile
from rclpy.time import Time as _Time

class ConverterOptions:
    input_serialization_format: str
    output_serialization_format: str
    def __init__(
        self, input_serialization_format: str = ..., output_serialization_format: str = ...
    ) -> None: ...

class StorageOptions:
    uri: str
    storage_id: str
    max_bagfile_size: int
    max_bagfile_duration: int
    max_cache_size: int
    storage_preset_profile: str
    storage_config_uri: str
    snapshot_mode: bool
    start_time_ns: int
    end_time_ns: int
    custom_data: dict[str, str]
    def __init__(
        self,
        uri: str,
        storage_id: str = ...,
        max_bagfile_size: int = ...,
        max_bagfile_duration: int = ...,
        max_cache_size: int = ...,
        storage_preset_profile: str = ...,
        storage_config_uri: str = ...,
        snapshot_mode: bool = ...,
        start_time_ns: int = ...,
        end_time_ns: int = ...,
        custom_data: dict[str, str] = ...,
        **others: Any,  # later releases have more
    ) -> None: ...

class StorageFilter:
    topics: list[str]
    services_events: list[str]
    regex: str
    exclude_topics: list[str]
    exclude_service_events: list[str]
    regex_to_exclude: str
    def __init__(
        self,
        topics: list[str] = ...,
        services_events: list[str] = ...,
        regex: str = ...,
        exclude_topics: list[str] = ...,
        exclude_service_events: list[str] = ...,
        regex_to_exclude: str = ...,
    ) -> None: ...

class MessageDefinition:
    topic_type: str
    encoding: str
    encoded_message_definition: str
    type_hash: str
    def __init__(
        self, topic_type: str, encoding: str, encoded_message_definition: str, type_hash: str
    ) -> None: ...

class TopicMetadata:
    id: int
    name: str
    type: str
    serialization_format: str
    offered_qos_profiles: list[Any]
    type_description_hash: str
    def __init__(
        self,
        id: int,
        name: str,
        type: str,
        serialization_format: str,
        offered_qos_profiles: list[Any] = ...,
        type_description_hash: str = ...,
    ) -> None: ...
    def equals(self, other: TopicMetadata, /) -> bool: ...

class TopicInformation:
    topic_metadata: TopicMetadata
    message_count: int
    def __init__(self, topic_metadata: TopicMetadata, message_count: int) -> None: ...

class FileInformation:
    path: str
    starting_time: _Time
    duration: _Duration
    message_count: int
    def __init__(
        self, path: str, starting_time: _Time, duration: _Duration, message_count: int
    ) -> None: ...

class BagMetadata:
    version: int
    bag_size: int
    storage_identifier: str
    relative_file_paths: list[str]
    files: list[FileInformation]
    duration: _Duration
    starting_time: _Time
    message_count: int
    topics_with_message_count: list[TopicInformation]
    compression_format: str
    compression_mode: str
    custom_data: dict[str, str]
    ros_distro: str
    def __init__(
        self,
        version: int = ...,
        bag_size: int = ...,
        storage_identifier: str = ...,
        relative_file_paths: list[str] = ...,
        files: list[FileInformation] = ...,
        duration: _Duration = ...,
        starting_time: _Time = ...,
        message_count: int = ...,
        topics_with_message_count: list[TopicInformation] = ...,
        compression_format: str = ...,
        compression_mode: str = ...,
        custom_data: dict[str, str] = ...,
        ros_distro: str = ...,
    ) -> None: ...

class MetadataIo:
    def __init__(self) -> None: ...
    def write_metadata(self, uri: str, metadata: BagMetadata, /) -> None: ...
    def read_metadata(self, uri: str, /) -> BagMetadata: ...
    def metadata_file_exists(self, uri: str, /) -> bool: ...
    def serialize_metadata(self, metadata: BagMetadata, /) -> str: ...
    def deserialize_metadata(self, text: str, /) -> BagMetadata: ...

class ReadOrderSortBy(IntEnum):
    ReceivedTimestamp = 0
    PublishedTimestamp = 1
    File = 2

class ReadOrder:
    sort_by: ReadOrderSortBy
    reverse: bool
    def __init__(self, sort_by: ReadOrderSortBy = ..., reverse: bool = ...) -> None: ...

def get_default_storage_id() -> str: ...
def convert_rclcpp_qos_to_rclpy_qos(qos: Any, /) -> QoSProfile: ...
def to_rclcpp_qos_vector(qos: str, version: int, /) -> list[Any]: ...
def __getattr__(name: str) -> Any: ...
