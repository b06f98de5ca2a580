"""Whether code runs: branches of distributions, guards, handlers and skips."""
