"""Applies fixes in memory until nothing is left to fix."""
