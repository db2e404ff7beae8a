#version 330 core
// The nearest surface as the light sees it: only depth is written. Drawn with flat.vert.

in vec3 uv_light;
flat in uvec4 rects;
flat in uint tint;

uniform sampler2D atlas;

const uint CUTOUT = 1u, UNLIT = 4u; // as in flat.frag

void main()
{
    uint kind = tint >> 24;
    if ((kind & UNLIT) != 0u)
        discard; // it casts no shadow
    if ((kind & CUTOUT) != 0u) {
        ivec2 corner = ivec2(rects.z & 0xFFFFu, rects.z >> 16);
        ivec2 size = ivec2(rects.w & 0xFFFFu, rects.w >> 16);
        ivec2 inside = clamp(ivec2(floor(uv_light.xy * vec2(size))), ivec2(0), size - 1);
        if (texelFetch(atlas, corner + inside, 0).a < 0.5)
            discard;
    }
}
