"""External programs: how to find and run them, and how this tool was installed."""
