"""Other programs: where they are, and how this one was installed."""
