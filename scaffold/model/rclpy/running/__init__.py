"""How nodes run: spins, callbacks, shutdown, and code that nothing calls."""
