"""Writing files: planned, locked, all of it or nothing."""
