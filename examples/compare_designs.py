"""How two designs differ, and from which layer on."""

from drapery import Banner, compare

first = Banner.parse("white stripe_bottom:red creeper:lime border:black")
other = Banner.parse("white stripe_bottom:red creeper:green border:black")
found = compare(first, other, size=(160, 200))
print(found.line())
found.sheet().save("difference.png")
