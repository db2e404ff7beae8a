"""Sheets of many labelled pictures: patterns, rotations, packs, the loom's steps."""
