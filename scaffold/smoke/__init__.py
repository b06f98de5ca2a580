"""Builds packages, runs their executables and compares what they do with what they say."""
