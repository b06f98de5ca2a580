"""What a rule is: base classes, loading, examples, documentation."""
