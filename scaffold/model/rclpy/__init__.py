"""The use of rclpy in a single file."""
