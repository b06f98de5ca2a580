"""Names of topics, QoS profiles, latched topics and transforms."""
