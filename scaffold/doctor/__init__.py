"""What is there of ROS 2 on this machine, what is missing, and what will cost hours."""
