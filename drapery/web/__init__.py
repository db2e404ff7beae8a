"""Live cloth in a browser: the viewer, its messages, and pages that need no server."""

NOT_PLAYED = ("layers", "pbr", "pixel", "pose", "backend", "turntable")
"""Options of pictures that a page with live cloth does not use."""
