"""Pictures of meshes. Knows textures, cameras and lights; never a banner, never a solver."""
