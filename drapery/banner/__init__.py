"""What a banner is, how it is written down, and the pictures it is made of."""
