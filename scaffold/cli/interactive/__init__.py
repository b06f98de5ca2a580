"""Interactive questions and progress bars."""
