"""The parts of `new` and `add`: flags for questions, and what they print."""
