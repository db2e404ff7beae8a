"""Minecraft banners as pictures of real cloth."""
