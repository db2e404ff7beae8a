"""One file a method; all are `Solver`s."""
