"""The packages around one, and what the machine knows of others."""
