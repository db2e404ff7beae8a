#version 330 core

in vec3 uv_light;
flat in uvec4 rects;
flat in uint tint;

uniform sampler2D atlas;
uniform vec3 light_tint;

out vec4 colour; // premultiplied, so that blending keeps the alpha of a transparent picture right

const uint CUTOUT = 1u, SOLID = 2u, UNLIT = 4u; // bits of the tint's last byte

vec4 texel(uvec2 rect)
{
    ivec2 corner = ivec2(rect.x & 0xFFFFu, rect.x >> 16), size = ivec2(rect.y & 0xFFFFu, rect.y >> 16);
    ivec2 inside = clamp(ivec2(floor(uv_light.xy * vec2(size))), ivec2(0), size - 1);
    return texelFetch(atlas, corner + inside, 0);
}

void main()
{
    uint kind = tint >> 24;
    if ((kind & CUTOUT) != 0u && texel(rects.zw).a < 0.5)
        discard;
    vec4 layer = texel(rects.xy);
    float alpha = (kind & SOLID) != 0u ? 1.0 : layer.a;
    vec3 shine = (kind & UNLIT) != 0u ? vec3(1.0) : uv_light.z * light_tint;
    vec3 dye = vec3(tint & 0xFFu, tint >> 8 & 0xFFu, tint >> 16 & 0xFFu);
    vec3 dyed = floor(layer.rgb * dye + 0.5) / 255.0;
    colour = vec4(dyed * shine * alpha, alpha);
}
