"""Contact of cloth with boxes and with itself, as kernels."""
