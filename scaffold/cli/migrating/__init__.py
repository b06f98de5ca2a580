"""The parts of `migrate`: origins of packages, their consequences, the report."""
