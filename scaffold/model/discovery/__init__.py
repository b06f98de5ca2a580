"""Which packages the paths of a user stand for."""
