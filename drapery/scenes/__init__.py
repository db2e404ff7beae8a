"""Ready-made scenes, one file each."""
