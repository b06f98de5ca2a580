"""The E and W codes."""
