"""The parts of the page, one file each: `build(session)` draws the part where it is called."""
