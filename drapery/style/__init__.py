"""From moving cloth to what is drawn."""
