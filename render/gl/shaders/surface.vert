#version 330 core
// The surface at each pixel, as in Buffers; covers the same pixels as flat.vert.

layout(location = 0) in vec4 position_depth; // [m]; w is the distance along the line of sight
layout(location = 1) in vec2 sprite_uv;      // fractions of the sprite
layout(location = 2) in vec3 direction;      // the normal
layout(location = 3) in uvec2 base_rect;     // of the lowest layer: x | y << 16, width | height << 16
layout(location = 4) in uvec2 owner;         // model; material << 1 | whether it is cut out

uniform mat4 P;

out vec3 uv_depth;
out vec3 normal;
flat out uvec4 ids;

void main()
{
    gl_Position = P * vec4(position_depth.xyz, 1.0);
    uv_depth = vec3(sprite_uv, position_depth.w);
    normal = direction;
    ids = uvec4(base_rect, owner);
}
