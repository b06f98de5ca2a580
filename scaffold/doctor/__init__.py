"""Diagnoses the ROS 2 environments of this machine and common mistakes."""
