#version 330 core

in vec3 uv_light;
flat in uvec4 rects;
flat in uint tint;

uniform sampler2D atlas;
uniform vec3 light_tint;

out vec4 colour; // premultiplied, so that blending keeps the alpha of a transparent picture right

const uint CUTOUT = 1u, SOLID = 2u, UNLIT = 4u; // bits of the tint's last byte

#ifdef CAST_SHADOWS
in vec4 receiver;

uniform sampler2D shadow_map;
uniform float spread; // distance of the places of the map that are compared [samples]
uniform int grid;     // samples along a pixel's side
uniform int height;   // of the picture [samples]

const int TAPS = 4; // places along one side of the square that is compared, as in soft/cast.py

// The share of places around that of a sample which the light reaches. Each sample of a pixel
// compares its own share of them. Rows are counted from the top here, as in soft/cast.py.
float sunlit()
{
    int side = textureSize(shadow_map, 0).x, lit = 0;
    ivec2 first = ivec2(gl_FragCoord.x, height - 1 - int(gl_FragCoord.y)) % grid;
    vec2 place = clamp(vec2(receiver.x, float(side) - receiver.y), 0.0, float(side - 1));
    for (int j = first.y; j < TAPS; j += grid)
        for (int i = first.x; i < TAPS; i += grid) {
            vec2 tap = place + (vec2(i, j) - 0.5 * float(TAPS - 1)) * spread;
            ivec2 at = clamp(ivec2(tap), ivec2(0), ivec2(side - 1));
            if (texelFetch(shadow_map, ivec2(at.x, side - 1 - at.y), 0).r >= receiver.z)
                ++lit;
        }
    return float(lit * grid * grid) / float(TAPS * TAPS);
}
#endif

float brightness()
{
    float bright = uv_light.z;
#ifdef CAST_SHADOWS
    if (bright > receiver.w)
        bright = receiver.w + (bright - receiver.w) * sunlit();
#endif
    return bright;
}

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
    vec3 shine = (kind & UNLIT) != 0u ? vec3(1.0) : brightness() * light_tint;
    vec3 dye = vec3(tint & 0xFFu, tint >> 8 & 0xFFu, tint >> 16 & 0xFFu);
    vec3 dyed = floor(layer.rgb * dye + 0.5) / 255.0;
    colour = vec4(dyed * shine * alpha, alpha);
}
