#version 330 core

in vec2 uv;
in float light;
flat in vec4 rect;
flat in vec4 base;
flat in vec4 tint;

uniform sampler2D atlas;
uniform vec3 light_tint;

out vec4 colour; // premultiplied, so that blending keeps the alpha of a transparent picture right

const int CUTOUT = 1, SOLID = 2, UNLIT = 4; // bits of tint.w

vec4 texel(vec4 place)
{
    vec2 inside = clamp(floor(uv * place.zw), vec2(0.0), place.zw - 1.0);
    return texelFetch(atlas, ivec2(place.xy + inside), 0);
}

void main()
{
    int kind = int(tint.w);
    if ((kind & CUTOUT) != 0 && texel(base).a < 0.5)
        discard;
    vec4 coat = texel(rect);
    float alpha = (kind & SOLID) != 0 ? 1.0 : coat.a;
    vec3 shine = (kind & UNLIT) != 0 ? vec3(1.0) : light * light_tint;
    vec3 dyed = floor(coat.rgb * tint.rgb + 0.5) / 255.0;
    colour = vec4(dyed * shine * alpha, alpha);
}
