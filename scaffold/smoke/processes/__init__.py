"""The processes of a run, including those that detach."""
