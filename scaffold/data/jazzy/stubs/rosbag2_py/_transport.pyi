from enum import IntEnum
from typing import Any

from rosbag2_py._storage import StorageOptions

class ServiceRequestsSource(IntEnum):
    SERVICE_INTROSPECTION = 0
    CLIENT_INTROSPECTION = 1

class PlayOptions:
    clock_publish_frequency: float
    clock_publish_on_topic_publish: bool
    clock_topics: list[str]
    delay: float
    disable_keyboard_controls: bool
    disable_loan_message: bool
    exclude_regex_to_filter: str
    exclude_service_events_to_filter: list[str]
    exclude_topics_to_filter: list[str]
    loop: bool
    node_prefix: str
    playback_duration: float
    playback_until_timestamp: int
    publish_service_requests: bool
    rate: float
    read_ahead_queue_size: int
    regex_to_filter: str
    service_requests_source: ServiceRequestsSource
    services_to_filter: list[str]
    start_offset: float
    start_paused: bool
    topic_qos_profile_overrides: dict[str, Any]
    topic_remapping_options: list[str]
    topics_to_filter: list[str]
    wait_acked_timeout: int
    def __init__(self) -> None: ...

# What these take was changed within each distribution: releases of Jazzy have both.
Player: Any

class RecordOptions:
    all_services: bool
    all_topics: bool
    compression_format: str
    compression_mode: str
    compression_queue_size: int
    compression_threads: int
    compression_threads_priority: int
    disable_keyboard_controls: bool
    exclude_regex: str
    exclude_service_events: list[str]
    exclude_topic_types: list[str]
    exclude_topics: list[str]
    ignore_leaf_topics: bool
    include_hidden_topics: bool
    include_unpublished_topics: bool
    is_discovery_disabled: bool
    node_prefix: str
    regex: str
    rmw_serialization_format: str
    services: list[str]
    start_paused: bool
    topic_polling_interval: Any
    topic_qos_profile_overrides: dict[str, Any]
    topic_types: list[str]
    topics: list[str]
    use_sim_time: bool
    def __init__(self) -> None: ...

Recorder: Any

bag_rewrite: Any
