#version 330 core
// Stands in for pyrender's own flat shader, which knows neither cutouts nor atlas rectangles.

layout(location = 0) in vec4 position_light; // [m]; w is the light's factor
layout(location = 1) in vec2 sprite_uv;      // fractions of the sprite
layout(location = 2) in vec4 coat_rect;      // x, y, width, height in the atlas [texels]
layout(location = 3) in vec4 base_rect;      // the same for the lowest coat
layout(location = 4) in vec4 coat_tint;      // 0..255; w holds the bits of flat.frag

uniform mat4 P;

out vec2 uv;
out float light;
flat out vec4 rect;
flat out vec4 base;
flat out vec4 tint;

void main()
{
    gl_Position = P * vec4(position_light.xyz, 1.0);
    uv = sprite_uv;
    light = position_light.w;
    rect = coat_rect;
    base = base_rect;
    tint = coat_tint;
}
