from rosbag2_py._compression_options import (
    CompressionMode as CompressionMode,
)
from rosbag2_py._compression_options import (
    CompressionOptions as CompressionOptions,
)
from rosbag2_py._compression_options import (
    compression_mode_from_string as compression_mode_from_string,
)
from rosbag2_py._compression_options import (
    compression_mode_to_string as compression_mode_to_string,
)
from rosbag2_py._info import Info as Info
from rosbag2_py._message_definitions import (
    LocalMessageDefinitionSource as LocalMessageDefinitionSource,
)
from rosbag2_py._reader import (
    SequentialCompressionReader as SequentialCompressionReader,
)
from rosbag2_py._reader import (
    SequentialReader as SequentialReader,
)
from rosbag2_py._reader import (
    get_registered_readers as get_registered_readers,
)
from rosbag2_py._reindexer import Reindexer as Reindexer
from rosbag2_py._storage import (
    BagMetadata as BagMetadata,
)
from rosbag2_py._storage import (
    ConverterOptions as ConverterOptions,
)
from rosbag2_py._storage import (
    FileInformation as FileInformation,
)
from rosbag2_py._storage import (
    MessageDefinition as MessageDefinition,
)
from rosbag2_py._storage import (
    MetadataIo as MetadataIo,
)
from rosbag2_py._storage import (
    ReadOrder as ReadOrder,
)
from rosbag2_py._storage import (
    ReadOrderSortBy as ReadOrderSortBy,
)
from rosbag2_py._storage import (
    StorageFilter as StorageFilter,
)
from rosbag2_py._storage import (
    StorageOptions as StorageOptions,
)
from rosbag2_py._storage import (
    TopicInformation as TopicInformation,
)
from rosbag2_py._storage import (
    TopicMetadata as TopicMetadata,
)
from rosbag2_py._storage import (
    convert_rclcpp_qos_to_rclpy_qos as convert_rclcpp_qos_to_rclpy_qos,
)
from rosbag2_py._storage import (
    get_default_storage_id as get_default_storage_id,
)
from rosbag2_py._storage import (
    to_rclcpp_qos_vector as to_rclcpp_qos_vector,
)
from rosbag2_py._transport import (
    Player as Player,
)
from rosbag2_py._transport import (
    PlayOptions as PlayOptions,
)
from rosbag2_py._transport import (
    Recorder as Recorder,
)
from rosbag2_py._transport import (
    RecordOptions as RecordOptions,
)
from rosbag2_py._transport import (
    ServiceRequestsSource as ServiceRequestsSource,
)
from rosbag2_py._transport import (
    bag_rewrite as bag_rewrite,
)
from rosbag2_py._writer import (
    SequentialCompressionWriter as SequentialCompressionWriter,
)
from rosbag2_py._writer import (
    SequentialWriter as SequentialWriter,
)
from rosbag2_py._writer import (
    get_registered_compressors as get_registered_compressors,
)
from rosbag2_py._writer import (
    get_registered_serializers as get_registered_serializers,
)
from rosbag2_py._writer import (
    get_registered_writers as get_registered_writers,
)
