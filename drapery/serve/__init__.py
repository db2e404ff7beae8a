"""A small HTTP service that draws banners from the parameters of an address."""
