// Sets y to y * scale plus element i of each kind of binding. The elements of TABLE are packed without gaps; a uniform
// block may have them only in the standard layout.
#version 450
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_EXT_scalar_block_layout : require
layout(local_size_x = 64) in;
layout(set = 0, binding = 0, std430) uniform Block
{
    uint n;
    float scale;
    float table[6];
};
layout(set = 0, binding = 1) uniform textureBuffer singles;
layout(set = 0, binding = 2) uniform textureBuffer fours;
layout(set = 0, binding = 3) buffer Y { float y[]; };
layout(set = 0, binding = 4) uniform utextureBuffer words;
layout(set = 0, binding = 5) uniform utextureBuffer pairs;

void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i >= n)
        return;
    vec4 four = texelFetch(fours, int(i));
    y[i] = y[i] * scale + table[i % 6] + 10 * texelFetch(singles, int(i)).x + four.x + 2 * four.y + 3 * four.z +
           4 * four.w;
    uvec2 pair = texelFetch(pairs, int(i)).rg;
    y[i] += float(texelFetch(words, int(i)).r) + 2 * float(pair.x) + 3 * float(pair.y);
}
