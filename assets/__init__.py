"""Our own art in the game's pack layout, and the code that draws it."""
