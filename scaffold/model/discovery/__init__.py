"""Finds the packages below the paths that a user gives."""
