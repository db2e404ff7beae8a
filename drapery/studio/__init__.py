"""The page where people design a banner and watch it wave: `drapery studio`."""
