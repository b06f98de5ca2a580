"""Which packages the paths given by a user select."""
