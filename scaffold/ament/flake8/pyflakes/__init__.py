"""The F codes."""
