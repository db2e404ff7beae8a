#version 330 core
// Stands in for pyrender's own flat shader, which knows neither cutouts nor atlas rectangles.

layout(location = 0) in vec4 position_light; // [m]; w is the light's factor
layout(location = 1) in vec2 sprite_uv;      // fractions of the sprite
layout(location = 2) in uvec2 layer_rect;    // x | y << 16, width | height << 16 [texels]
layout(location = 3) in uvec2 base_rect;     // the same for the lowest layer
layout(location = 4) in uint layer_tint;     // a byte each: red, green, blue, bits of flat.frag

uniform mat4 P;

#ifdef CAST_SHADOWS
layout(location = 5) in vec4 lifted_dark; // where it looks itself up in the map [m]; dark brightness
uniform mat4 light_matrix;                // world to the map's clip space
uniform float map_side;                   // its samples along one side
out vec4 receiver;                        // place in the map [samples], depth, dark brightness
#endif

out vec3 uv_light;
flat out uvec4 rects; // few values between the shaders: llvmpipe sets up each for every triangle
flat out uint tint;

void main()
{
    gl_Position = P * vec4(position_light.xyz, 1.0);
    uv_light = vec3(sprite_uv, position_light.w);
    rects = uvec4(layer_rect, base_rect);
    tint = layer_tint;
#ifdef CAST_SHADOWS
    vec3 seen = (light_matrix * vec4(lifted_dark.xyz, 1.0)).xyz * 0.5 + 0.5;
    receiver = vec4(seen.xy * map_side, seen.z, lifted_dark.w);
#endif
}
