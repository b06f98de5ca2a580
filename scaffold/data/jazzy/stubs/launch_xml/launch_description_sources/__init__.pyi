from launch_xml.launch_description_sources.xml_launch_description_source import (
    XMLLaunchDescriptionSource as XMLLaunchDescriptionSource,
)
