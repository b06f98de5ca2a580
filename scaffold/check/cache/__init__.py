"""What earlier runs of `check` leave in the user's cache."""
