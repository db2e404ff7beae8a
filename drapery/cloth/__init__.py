"""The simulation core. Knows nothing of Minecraft, textures or pixels."""
