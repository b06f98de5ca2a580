"""What the user and the project configure, and which of it is trusted."""
