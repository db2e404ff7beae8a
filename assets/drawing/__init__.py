"""The code that draws our own art. It is part of the checkout, not of the installed package."""
