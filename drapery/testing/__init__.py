"""Golden-image tests: a pytest plugin, and the same checks without writing Python."""
