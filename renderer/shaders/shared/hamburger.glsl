// SPDX-License-Identifier: MIT
// Moment shadow maps: the sharpest lower bound on the shadow that four moments allow, a Hamburger moment problem.
// C. Peters, R. Klein, "Moment shadow mapping", I3D 2015, algorithm 3. Needs filtered_map.glsl. Depths are on [-1,1]:
// on [0,1] the Hankel matrix of a cleared texel is singular whatever it is biased towards.

// Moments of depth on [-1,1] from depth on [0,1].
SHARED_FUNCTION real4 momentsOfDepth(real depth) {
    real z = real(2.0) * depth - real(1.0);
    real square = z * z;
    return real4(z, square, square * z, square * square);
}

// Shares of a point nearer than `depth` in the distribution of two points with mean m1 and mean square m2, of which
// `depth` is one: what four moments come to where they do not say more.
SHARED_FUNCTION real shadowOfTwoMoments(real mean, real variance, real depth) {
    if (!(depth > mean)) return real(0.0);
    real beyond = depth - mean;
    real ratio = variance / beyond;
    return beyond / (ratio + beyond);
}

// The point of {depth, first, second} that are the support of the extremal distribution: the weight of those before
// depth. Written so that no weight is a difference of larger ones.
SHARED_FUNCTION real weightBefore(real depth, real first, real second, real m1, real m2) {
    if (second < depth)
        return real(1.0) - (first * second - m1 * (first + second) + m2) / ((depth - first) * (depth - second));
    if (first < depth) return (depth * second - m1 * (depth + second) + m2) / ((second - first) * (depth - first));
    return real(0.0);
}

// Least share of a distribution with these moments that lies nearer than depth, all on [-1,1]; alpha moves the moments
// towards those of a distribution that has room in every direction, so that rounding does not take them out of the
// possible ones.
SHARED_FUNCTION real hamburgerShadow(real4 moments, real depth, real alpha) {
    real4 b = mix(moments, real4(0.0, 0.628, 0.0, 0.628), alpha);
    // Cholesky factors of the Hankel matrix (1 b1 b2; b1 b2 b3; b2 b3 b4).
    real variance = b.y - b.x * b.x;  // D22
    real l32d22 = b.z - b.x * b.y;
    real squareVariance = b.w - b.y * b.y;
    // A single depth, up to rounding. The square of the depth's rounding; below it the quotients are noise.
    if (!(variance > real(1e-12))) return depth > b.x ? real(1.0) : real(0.0);
    real d33d22 = max(squareVariance * variance - l32d22 * l32d22, real(0.0));
    real l32 = l32d22 / variance;
    // The polynomial c2 z^2 + c1 z + c0 whose roots are the other points of the support, times D33 D22, so that two
    // depths, where D33 is 0, need no division by it.
    real c2 = (depth * depth - b.y - l32 * (depth - b.x)) * variance;
    real c1 = (depth - b.x) / variance * d33d22 - l32 * c2;
    real c0 = d33d22 - c1 * b.x - c2 * b.y;
    real scale = max(max(abs(c0), abs(c1)), abs(c2));
    // Depth is a node of the Gauss quadrature of three points: one of the roots is infinitely far, with no weight. And
    // where depth is one of two depths nothing is left at all.
    if (abs(c2) <= real(1e-7) * scale || !(scale > real(0.0)))
        return shadowOfTwoMoments(b.x, variance, depth);
    real p = c1 / c2;
    real q = c0 / c2;
    real root = sqrt(max(real(0.25) * p * p - q, real(0.0)));
    // The root that no difference makes; the other one follows from their product.
    real far = real(-0.5) * p + (p > real(0.0) ? -root : root);
    real near = far == real(0.0) ? real(0.0) : q / far;
    return weightBefore(depth, min(far, near), max(far, near), b.x, b.y);
}

// 1 - the bound, whatever comes out of it.
SHARED_FUNCTION real hamburgerVisibility(real4 moments, real depth, real alpha) {
    return unitRange(real(1.0) - hamburgerShadow(moments, real(2.0) * depth - real(1.0), alpha));
}
