"""How two pictures differ: figures, panels to look at, and a report."""
