"""``smoke.yaml``: the expectations of the author."""
