// SPDX-License-Identifier: MIT
// What C++ and GLSL share: the uniform blocks of a frame. Compiled as GLSL (real is float) and as C++ for float and
// double (renderer/shader_math.h, which asserts the std140 offsets). Only 16-byte members, so that std140 holds no
// surprises.

// The camera. Positions are relative to the eye: world coordinates far from the origin would lose bits.
struct ViewConstants {
    real4x4 clipFromEyeRelative;  // camera projection x view, without the translation
    real4 eye;                    // xyz world position of the camera
    real4 pixelRight;             // xyz right vector x width of one pixel at distance 1 along the view axis
    real4 pixelUp;                // xyz up vector x height of one pixel at distance 1
    real4 forward;                // xyz view axis, unit length
    real4 viewport;               // x width, y height in px, z 1/width, w 1/height
};

// One light with its map and kernel.
struct ShadowConstants {
    real4x4 shadowFromEyeRelative;  // to (u w, v w, depth, w): depth is linear in [0,1], 0 near, and not divided by w
    real4x4 shadowFromWorld;        // the same from world positions, for the depth pass
    real4 towardsLight;             // xyz unit vector to the sun; with w 1 the lamp's place relative to the eye
    real4 map;                      // x resolution N in texels, y 1/N, z 1/(edge of the texture that holds the map);
                                    // w (far - near) / near of a light that is a point, 0 of the sun
    real4 kernel;                   // x radius, y least radius where texels show, both as a fraction of the map's extent;
                                    // z samples along a screen pixel's edge (1 but for antialiased pictures)
    real4 parameters[2];            // of the technique, in the order of its table row
    real4 scale;                    // of a lamp: x least distance, y that depth 0..1 spans beyond it, in m along the
                                    // map's axis; z the map's width, in m (of a lamp: at 1 m); w 1 for a lamp
    real4 part;                     // the receivers that this map serves: xy least, zw greatest uv,
    real4 stretch;                  // x, y from and up to which distance along the view axis in m
    real4 prefilter;                // x the kernel's standard deviation in texels, y 1 if it is a Gaussian and 0 if a box,
                                    // z texels of the guard band; w 1 if a texel is split into high and low parts,
                                    // or minus the levels of a mip chain above its first, or minus the units of summed
                                    // texels that make 1
    real4 layerEnds[4];             // of a layered technique: where each of up to 16 layers of depth ends
};

// How the lit pass looks. Colours are linear light.
struct LookConstants {
    real4 sunColour;
    real4 zenithColour;
    real4 horizonColour;
    real4 skyLight;      // what the whole sky sheds on a surface that faces up
    real4 groundLight;   // what the ground throws back at one that faces down
    real4 tone;          // x exposure, y distance in m at which haze takes half
};
