"""What is needed to publish Drapery; not installed. See `docs/release.md`."""
