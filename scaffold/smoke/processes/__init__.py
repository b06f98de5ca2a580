"""The processes of a run, those that escape included."""
