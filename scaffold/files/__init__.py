"""What is on disk: files, trees of them, and the user's cache."""
