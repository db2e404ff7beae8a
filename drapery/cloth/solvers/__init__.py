"""The solvers, one file for each method; all follow the `Solver` protocol."""
