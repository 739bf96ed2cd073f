// SPDX-License-Identifier: MIT
// From a visible surface point to what a shadow technique needs to know of it. Needs constants.glsl.

struct ShadowReceiver {
    real2 uv;             // on the map, [0,1] inside it
    real depth;           // linear light depth, 0 near, 1 far
    real2 depthGradient;  // d depth / d uv of the plane that the surface lies in
    real depthError;      // how far float32 may have moved depth here or in the map
    real footprintUv;     // edge of one screen pixel on the map, as METHODS' pixel bound takes it
    real2 longestStep;    // the longer of the steps of uv along one screen pixel in x and in y
    bool facesLight;      // surfaces turned away are in shadow without a lookup
};

// Below this sine of the angle between the light and the plane, uv no longer spans the plane.
const real kLeastDeterminant = real(1e-3);
// The footprint counts as no more than this much longer than wide (METHODS section 7): grazing light would ask for
// infinity where there is little contrast to see.
const real kAnisotropyLimit = real(4.0);
// Eight rounding steps of float32: transforms and interpolation on both sides.
const real kRounding = real(4.8e-7);

// Receiver-plane depth gradient (J. Isidoro, "Shadow mapping: GPU-based tips and techniques", GDC 2006), from the
// plane's normal instead of screen derivatives: exact, and free of the derivatives' errors at silhouettes. The
// arguments are the world-space gradients of u, v and depth. A zero or tiny determinant gives gradient 0.
SHARED_FUNCTION real2 receiverPlaneGradient(real3 gradientU, real3 gradientV, real3 gradientDepth,
                                            real3 planeNormal) {
    real3 acrossU = cross(gradientV, planeNormal);
    real determinant = dot(gradientU, acrossU);
    real scale = length(gradientU) * length(gradientV) * length(planeNormal);
    if (!(abs(determinant) > kLeastDeterminant * scale)) return real2(0.0);
    real3 acrossV = cross(planeNormal, gradientU);
    return real2(dot(gradientDepth, acrossU), dot(gradientDepth, acrossV)) / determinant;
}

// The smaller singular value of d(uv)/d(pixel), but at least 1/kAnisotropyLimit of the larger one. Columns are the
// steps of uv along one pixel in x and in y.
SHARED_FUNCTION real pixelFootprint(real2 alongX, real2 alongY) {
    real squares = dot(alongX, alongX) + dot(alongY, alongY);
    real area = abs(alongX.x * alongY.y - alongX.y * alongY.x);
    real larger = real(0.5) * (sqrt(squares + real(2.0) * area) + sqrt(max(squares - real(2.0) * area, real(0.0))));
    if (!(larger > real(0.0))) return real(0.0);
    return max(area / larger, larger / kAnisotropyLimit);
}

// How far the surface point moves for one pixel: the neighbouring ray's hit on the same plane.
SHARED_FUNCTION real3 stepOnPlane(real3 eyeRelative, real3 planeNormal, real3 pixelStep) {
    real facing = dot(planeNormal, eyeRelative);
    real least = real(1e-4) * length(planeNormal) * length(eyeRelative);
    if (abs(facing) < least) facing = facing < real(0.0) ? -least : least;
    return pixelStep - eyeRelative * (dot(planeNormal, pixelStep) / facing);
}

// From the surface point, of any length.
SHARED_FUNCTION real3 towardsLight(real3 eyeRelative, ShadowConstants shadow) {
    return real3(shadow.towardsLight) - eyeRelative * shadow.towardsLight.w;
}

// eyeRelative: the surface point minus the eye. planeNormal: of the triangle, not the shading normal, turned to the
// viewer.
SHARED_FUNCTION ShadowReceiver shadowReceiver(real3 eyeRelative, real3 planeNormal, ViewConstants view,
                                              ShadowConstants shadow) {
    real4x4 m = shadow.shadowFromEyeRelative;
    real4 h = m * real4(eyeRelative, 1.0);
    real3 rowU = real3(m[0][0], m[1][0], m[2][0]);
    real3 rowV = real3(m[0][1], m[1][1], m[2][1]);
    real3 rowW = real3(m[0][3], m[1][3], m[2][3]);

    ShadowReceiver receiver;
    receiver.uv = real2(h.x, h.y) / h.w;
    receiver.depth = h.z;
    real3 gradientU = (rowU - rowW * receiver.uv.x) / h.w;
    real3 gradientV = (rowV - rowW * receiver.uv.y) / h.w;
    real3 gradientDepth = real3(m[0][2], m[1][2], m[2][2]);
    receiver.depthGradient = receiverPlaneGradient(gradientU, gradientV, gradientDepth, planeNormal);
    real reach = length(eyeRelative) + length(real3(view.eye));
    receiver.depthError = kRounding * (real(1.0) + reach * length(gradientDepth));

    real viewDepth = dot(eyeRelative, real3(view.forward));
    real3 alongX = stepOnPlane(eyeRelative, planeNormal, real3(view.pixelRight) * viewDepth);
    real3 alongY = stepOnPlane(eyeRelative, planeNormal, real3(view.pixelUp) * viewDepth);
    real2 stepX = real2(dot(gradientU, alongX), dot(gradientV, alongX));
    real2 stepY = real2(dot(gradientU, alongY), dot(gradientV, alongY));
    receiver.footprintUv = pixelFootprint(stepX, stepY);
    receiver.longestStep = dot(stepX, stepX) > dot(stepY, stepY) ? stepX : stepY;
    receiver.facesLight = dot(planeNormal, towardsLight(eyeRelative, shadow)) > real(0.0);
    return receiver;
}

// Whether this map is the one for a receiver: of a cascade those in its stretch of the view, of a cube's face those in
// its quarter, of a spot those in its square.
SHARED_FUNCTION bool serves(ShadowReceiver receiver, real viewDistance, ShadowConstants shadow) {
    if (!(viewDistance >= shadow.stretch.x && viewDistance < shadow.stretch.y)) return false;
    // Behind the lamp uv are mirrored.
    if (shadow.scale.w != real(0.0) && !(receiver.depth * shadow.scale.y + shadow.scale.x > real(0.0))) return false;
    return receiver.uv.x >= shadow.part.x && receiver.uv.y >= shadow.part.y && receiver.uv.x <= shadow.part.z &&
           receiver.uv.y <= shadow.part.w;
}

// Half a code value of a display: what lies nearer to light or shadow is one of them to any eye. Sums of weights leave
// 1e-7 of light in a full shadow.
const real kVisibleShare = real(1.0) / real(510.0);

SHARED_FUNCTION bool inPenumbra(real visibility) {
    return visibility > kVisibleShare && visibility < real(1.0) - kVisibleShare;
}

// A kernel's radius at this receiver, as a fraction of the map's extent, in [0,1], where softness asks for `radius`.
// Where the map is smaller than the softness asks for, the controller hands back a least radius (METHODS section 7); it
// holds where a texel is larger than two pixels, not at all where it is smaller than one, and fades in between (the
// fade is chosen by eye: a hard switch would draw a line across the ground).
SHARED_FUNCTION real shownRadiusUv(real radius, ShadowReceiver receiver, ShadowConstants shadow) {
    real texelsPerPixel = receiver.footprintUv * shadow.kernel.z * shadow.map.x;
    real texelShows = clamp(real(1.0) / max(texelsPerPixel, real(1e-6)) - real(1.0), real(0.0), real(1.0));
    return clamp(mix(radius, max(radius, shadow.kernel.y), texelShows), real(0.0), real(1.0));
}

SHARED_FUNCTION real kernelRadiusUv(ShadowReceiver receiver, ShadowConstants shadow) {
    return shownRadiusUv(shadow.kernel.x, receiver, shadow);
}
