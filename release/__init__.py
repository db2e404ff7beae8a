"""What is needed to publish Drapery; not installed. See CONTRIBUTING.md."""
