"""Results of earlier runs of `check` in the user's cache."""
