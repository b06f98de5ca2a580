"""Configuration of the user and the project, and trust."""
