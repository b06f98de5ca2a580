"""Builds packages, runs their executables, and compares behavior with the source."""
