"""Live cloth in a browser: the viewer, its messages, and pages that need no server."""
