"""The commands, one file each; what they draw with is imported when they run."""
