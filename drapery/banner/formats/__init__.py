"""Every written form of a banner, one file a form."""
