"""Parameters in the rclpy code of one file."""
