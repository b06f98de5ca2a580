"""The parts of `check`: flags, fixes, baselines, distributions, standard input."""
