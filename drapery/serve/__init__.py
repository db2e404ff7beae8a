"""A small service over HTTP: pictures of banners by their address."""
