"""The commands, one module for each. A command imports its dependencies when it runs."""
