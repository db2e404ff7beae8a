"""Our own art in the game's pack layout. `assets/drawing` in the checkout draws it."""
