"""Many pictures: a manifest of jobs, done on one machine or many, that survives faults."""
