"""What the rclpy code of one file says."""
