#version 330 core

in vec3 uv_depth;
in vec3 normal;
flat in uvec4 ids;

uniform sampler2D atlas;

layout(location = 0) out vec4 normal_depth;
layout(location = 1) out vec2 uv;
layout(location = 2) out ivec2 model_material;

void main()
{
    if ((ids.w & 1u) != 0u) {
        ivec2 corner = ivec2(ids.x & 0xFFFFu, ids.x >> 16), size = ivec2(ids.y & 0xFFFFu, ids.y >> 16);
        ivec2 inside = clamp(ivec2(floor(uv_depth.xy * vec2(size))), ivec2(0), size - 1);
        if (texelFetch(atlas, corner + inside, 0).a < 0.5)
            discard;
    }
    normal_depth = vec4(normal / max(length(normal), 1e-12), uv_depth.z);
    uv = uv_depth.xy;
    model_material = ivec2(ids.z, ids.w >> 1);
}
