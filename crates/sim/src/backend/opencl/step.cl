// The physics of docs/physics.md for OpenCL devices, with the same bits as the kernel of `lanes`.
//
// A work-group simulates one robot for many env steps. The positions of its masses are in local memory; the rest of
// its state is in the registers of the work-item that owns the mass or the spring. A Runge-Kutta stage has two halves:
// each work-item computes its springs' forces, then each gathers the forces on its masses, in exactly the order in
// which `lanes/step.rs` adds them. Every operation is rounded as written: none is fused with another.
//
// The host puts the numbers of the physics and these sizes in front of this text: GROUP, the work-items of a group;
// MASSES, SPRINGS and TILES, the most that a robot has.

#pragma OPENCL EXTENSION cl_khr_fp64 : enable
#pragma OPENCL FP_CONTRACT OFF

#define SHARE(count) (((count) + GROUP - 1) / GROUP)
#define WORDS(count) (((count) + 31) / 32)
#define MASS_SHARE SHARE(MASSES)
#define SPRING_SHARE SHARE(SPRINGS)
#define POINT_WORDS WORDS(MASSES)
#define TILE_WORDS WORDS(TILES)

// Each of a work-item's masses, tiles and so on: `index` runs over those of the group in turn.
#define EACH(index, count) for (uint index = item; index < (count); index += GROUP)

// All work-items wait for each other.
#if GROUP == 1
#define SYNC()
#else
#define SYNC() barrier(CLK_LOCAL_MEM_FENCE)
#endif

// PoCL copies all that follows a branch with a barrier, so there (APART) such statements are not skipped: they do
// nothing when there is nothing to do. For the same reason loops with a barrier are run once at least, and what has no
// barrier is in functions of its own.
#ifdef APART
#define WHEN(condition)
#define PART __attribute__((noinline))
#else
#define WHEN(condition) if (condition)
#define PART
#endif

// No mass, spring or tile.
#define NONE 0xffffu

// Candidates for a contact that are tested together, and contacts whose forces are computed together.
#define TESTED 256
#define PUSHED 32

// Room for spring forces, corrections or contact forces, which are not needed at the same time.
#define SCRATCH (SPRINGS > 3 * PUSHED ? SPRINGS : 3 * PUSHED)

// The faults of a simulation, as the host reads them.
#define SOUND 0
#define UNSTABLE 1
#define NON_FINITE 2

// The words that describe a body: where its plan and its stiffnesses begin, and its counts.
enum { BODY_PLAN, BODY_STIFFNESS, BODY_MASSES, BODY_FRAMES, BODY_RIMS, BODY_DRIVEN, BODY_TILES, BODY_POINTS,
       BODY_LEVELS, BODY_COUNTABLE, BODY_WORDS };

// The words that describe a robot: its body, where its masses and its targets begin, env steps to do.
enum { ROBOT_BODY, ROBOT_STATE, ROBOT_TARGETS, ROBOT_STEPS, ROBOT_WORDS };

// The words of a tile in the plan: four corners, surface sides as bits, row, column.
enum { TILE_SIDES = 4, TILE_ROW, TILE_COLUMN, TILE_SIZE };

// A body's plan, and the robot's place in local memory.
typedef struct {
    uint masses, springs, springs_in_frames, driven, tiles, points, levels, countable;
    // The ends of each spring, the earlier mass first.
    __global const ushort *ends;
    // The goal of each spring: 0 and 1 are those of sides and diagonals at rest, then the driven springs.
    __global const ushort *aims;
    // For each mass: rims that end in it, two; rims that begin in it, two; the first spring of the frames above left,
    // above right, below left and below right of it.
    __global const ushort *gather;
    // For each mass: the surface voxels above left, above right, below left and below right of it.
    __global const ushort *around;
    // The mass of each point, in order of creation.
    __global const ushort *order;
    // The channels of the owners of each driven spring.
    __global const ushort *owners;
    // The surface voxels.
    __global const ushort *surface;
    // The masses of surface voxels.
    __global const ushort *skin;
    // Where each level of rigid voxels ends, and their corners: voxels of one level have no mass in common.
    __global const ushort *levels_end;
    __global const ushort *rigid;
    __global const double *stiffness;
    // Positions, in the current stage, one substep ago, and when the lists of close pairs were made.
    __local double2 *at;
    __local double2 *stage;
    __local double2 *before;
    __local double2 *reference;
    __local double2 *scratch;
    // The masses on which the contact forces in `scratch` act.
    __local ushort *target;
    // Bits: points near a tile, points inside it, and tiles near it.
    __local uint *near_points;
    __local uint *inside;
    __local uint *near_tiles;
    // Bits: tiles with a low corner; candidates that are contacts.
    __local uint *low;
    __local uint *hits;
    // Low tiles with the range of ground voxels below each, or points inside tiles.
    __local uint *list;
    __local uint *first_column;
    __local uint *column_count;
    // Counters and flags.
    __local uint *moved;
    __local uint *any_inside;
    __local uint *pairs;
    __local uint *suspect;
    __local uint *unstable;
    __local uint *columns;
    __local uint *bites;
    __local uint *rigid_bites;
} Robot;

// ---------------------------------------------------------------------------------------------------------------------
// Functions that have the same bits on every machine

// 1/sqrt(x) to a unit in the last place: root and quotient in single precision, then one cubic step.
double reciprocal_root(double x) {
#ifdef ROUND_THROUGH_DOUBLE
    // For devices whose root and quotient in single precision are not correctly rounded: these are.
    float root = (float)sqrt((double)(float)x);
    double seed = (double)(float)(1.0 / (double)root);
#else
    double seed = (double)(1.0f / sqrt((float)x));
#endif
    double error = 1.0 - x * (seed * seed);
    return seed + (seed * error) * (0.5 + 0.375 * error);
}

// exp(x) - 1 with the bits of the crate `libm`, which follows FreeBSD:
// Copyright (C) 1993 by Sun Microsystems, Inc. All rights reserved. Developed at SunPro, a Sun Microsystems, Inc.
// business. Permission to use, copy, modify, and distribute this software is freely granted, provided that this notice
// is preserved.
PART double exponential_less_one(double x) {
    const double ln2_high = as_double(0x3fe62e42fee00000UL), ln2_low = as_double(0x3dea39ef35793c76UL);
    const double per_ln2 = as_double(0x3ff71547652b82feUL);
    const double q1 = as_double(0xbfa11111111110f4UL), q2 = as_double(0x3f5a01a019fe5585UL);
    const double q3 = as_double(0xbf14ce199eaadbb7UL), q4 = as_double(0x3ed0cfca86e65239UL);
    const double q5 = as_double(0xbe8afdb76e09c32dUL);
    uint high = (uint)(as_ulong(x) >> 32) & 0x7fffffff;
    bool negative = as_ulong(x) >> 63 != 0;
    double correction = 0.0;
    int k = 0;
    if (high >= 0x4043687a) {
        if (isnan(x)) return x;
        if (negative) return -1.0;
        if (x > as_double(0x40862e42fefa39efUL)) return x * as_double(0x7fe0000000000000UL);
    }
    if (high > 0x3fd62e42) {
        double upper, lower;
        if (high < 0x3ff0a2b2) {
            upper = negative ? x + ln2_high : x - ln2_high;
            lower = negative ? -ln2_low : ln2_low;
            k = negative ? -1 : 1;
        } else {
            k = (int)(per_ln2 * x + (negative ? -0.5 : 0.5));
            upper = x - (double)k * ln2_high;
            lower = (double)k * ln2_low;
        }
        x = upper - lower;
        correction = (upper - x) - lower;
    } else if (high < 0x3c900000) {
        return x;
    }
    double half_x = 0.5 * x;
    double half_square = x * half_x;
    double r1 = 1.0 + half_square * (q1 + half_square * (q2 + half_square * (q3 + half_square * (q4 + half_square * q5))));
    double t = 3.0 - r1 * half_x;
    double e = half_square * ((r1 - t) / (6.0 - x * t));
    if (k == 0) return x - (x * e - half_square);
    e = x * (e - correction) - correction;
    e -= half_square;
    if (k == -1) return 0.5 * (x - e) - 0.5;
    if (k == 1) return x < -0.25 ? -2.0 * (e - (x + 0.5)) : 1.0 + 2.0 * (x - e);
    double power = as_double((ulong)(0x3ff + k) << 52);
    if (k < 0 || k > 56) {
        double y = x - e + 1.0;
        y = k == 1024 ? y * 2.0 * as_double(0x7fe0000000000000UL) : y * power;
        return y - 1.0;
    }
    double inverse = as_double((ulong)(0x3ff - k) << 52);
    return k < 20 ? (x - e + (1.0 - inverse)) * power : (x - (e + inverse) + 1.0) * power;
}

// tanh(x) with the bits of the crate `libm`.
PART double hyperbolic_tangent(double x) {
    bool negative = as_ulong(x) >> 63 != 0;
    double size = fabs(x);
    uint high = (uint)(as_ulong(size) >> 32);
    double t;
    if (high > 0x3fe193ea) {
        if (high > 0x40340000) {
            t = 1.0 - 0.0 / size;
        } else {
            t = exponential_less_one(2.0 * size);
            t = 1.0 - 2.0 / (t + 2.0);
        }
    } else if (high > 0x3fd058ae) {
        t = exponential_less_one(2.0 * size);
        t = t / (t + 2.0);
    } else if (high >= 0x00100000) {
        t = exponential_less_one(-2.0 * size);
        t = -t / (t + 2.0);
    } else {
        t = size;
    }
    return negative ? -t : t;
}

// The greater and the less, the second one if either is not a number.
double greater(double a, double b) { return a > b ? a : b; }
double lesser(double a, double b) { return a < b ? a : b; }

double square_of(double2 r) { return r.x * r.x + r.y * r.y; }
double dot_product(double2 a, double2 b) { return a.x * b.x + a.y * b.y; }
double cross_product(double2 a, double2 b) { return a.x * b.y - a.y * b.x; }
double length_of(double2 e) { return sqrt(dot_product(e, e)); }

// ---------------------------------------------------------------------------------------------------------------------
// Close pairs, and the instability test (docs/physics.md 7 and 9)

// The least and greatest coordinates of a tile.
typedef struct {
    double2 least, greatest;
} Bounds;

__global const ushort *tile(const Robot *r, uint n) { return r->surface + n * TILE_SIZE; }

PART Bounds tile_bounds(const Robot *r, uint n) {
    __global const ushort *corners = tile(r, n);
    double2 a = r->at[corners[0]], b = r->at[corners[1]], c = r->at[corners[2]], d = r->at[corners[3]];
    Bounds bounds;
    bounds.least = (double2)(lesser(lesser(a.x, b.x), lesser(c.x, d.x)), lesser(lesser(a.y, b.y), lesser(c.y, d.y)));
    bounds.greatest =
        (double2)(greater(greater(a.x, b.x), greater(c.x, d.x)), greater(greater(a.y, b.y), greater(c.y, d.y)));
    return bounds;
}

// The distance of two boxes along the axis where it is largest; negative if they overlap.
double gap(Bounds a, Bounds b) {
    double x = greater(a.least.x - b.greatest.x, b.least.x - a.greatest.x);
    double y = greater(a.least.y - b.greatest.y, b.least.y - a.greatest.y);
    return greater(x, y);
}

Bounds at_point(double2 point) {
    Bounds bounds = { point, point };
    return bounds;
}

bool overlap(Bounds a, Bounds b) {
    return a.least.x <= b.greatest.x && b.least.x <= a.greatest.x && a.least.y <= b.greatest.y &&
           b.least.y <= a.greatest.y;
}

// Whether two tiles differ by more than one row or column.
bool are_apart(const Robot *r, uint n, uint m) {
    __global const ushort *a = tile(r, n), *b = tile(r, m);
    return abs_diff((int)a[TILE_ROW], (int)b[TILE_ROW]) > 1 || abs_diff((int)a[TILE_COLUMN], (int)b[TILE_COLUMN]) > 1;
}

bool has_corner(__global const ushort *tile, uint mass) {
    return tile[0] == mass || tile[1] == mass || tile[2] == mass || tile[3] == mass;
}

// Whether a point is inside the voxel with these corners (docs/physics.md 7.2).
bool is_inside(double2 point, double2 c0, double2 c1, double2 c2, double2 c3) {
    double2 tl = c0 - point, tr = c1 - point, br = c2 - point, bl = c3 - point;
    double c = cross_product(br, tl);
    bool upper = 0.0 <= c * cross_product(tl, tr) && 0.0 <= c * cross_product(tr, br);
    bool lower = 0.0 <= c * cross_product(tl, bl) && 0.0 <= c * cross_product(bl, br);
    return upper || lower;
}

// Clears what the survey of the next substep finds.
PART void clear_survey(const Robot *r, uint item) {
    EACH(word, TILE_WORDS) r->low[word] = 0;
    if (item == 0) {
        *r->moved = 0;
        *r->any_inside = 0;
        *r->columns = 0;
    }
}

// Lists the tiles with a corner on or below the ground's face, and finds out whether a point has moved so far that the
// lists of close pairs have to be made again.
PART void survey(const Robot *r, uint item) {
    EACH(p, r->points) {
        uint mass = r->skin[p];
        double2 way = r->at[mass] - r->reference[p];
        if (BUDGET <= fabs(way.x) || BUDGET <= fabs(way.y)) *r->moved = 1;
        if (r->at[mass].y <= CELL) {
            for (uint n = 0; n < 4; n++) {
                uint tile = r->around[4 * mass + n];
                if (tile != NONE) atomic_or(&r->low[tile / 32], 1u << tile % 32);
            }
        }
    }
}

// Notes where the points are when the lists of close pairs are made.
PART void mark_points(const Robot *r, uint item) {
    if (item == 0) *r->pairs = 0;
    EACH(p, r->points) r->reference[p] = r->at[r->skin[p]];
}

// The points near a tile, 32 of them as bits.
PART uint near_points_of(const Robot *r, uint own, uint word) {
    uint bits = 0;
    Bounds bounds = tile_bounds(r, own);
    for (uint p = 32 * word; p < min(32 * word + 32, r->points); p++) {
        uint mass = r->skin[p];
        if (gap(bounds, at_point(r->at[mass])) <= MARGIN && !has_corner(tile(r, own), mass)) bits |= 1u << p % 32;
    }
    return bits;
}

// The tiles after a tile that are near it and apart from it, 32 of them as bits.
PART uint near_tiles_of(const Robot *r, uint own, uint word) {
    uint bits = 0;
    Bounds bounds = tile_bounds(r, own);
    for (uint m = max(32 * word, own + 1); m < min(32 * word + 32, r->tiles); m++) {
        if (are_apart(r, own, m) && gap(bounds, tile_bounds(r, m)) <= MARGIN) bits |= 1u << m % 32;
    }
    return bits;
}

// Makes the lists of close pairs.
PART void list_close_pairs(const Robot *r, uint item) {
    uint words = WORDS(r->points);
    EACH(n, r->tiles * words) r->near_points[n / words * POINT_WORDS + n % words] = near_points_of(r, n / words, n % words);
    words = WORDS(r->tiles);
    EACH(n, r->tiles * words) {
        uint bits = near_tiles_of(r, n / words, n % words);
        r->near_tiles[n / words * TILE_WORDS + n % words] = bits;
        if (bits != 0) atomic_add(r->pairs, popcount(bits));
    }
}

// Makes the lists again, and finds out whether the robot has so many close pairs that it might be unstable.
void renew(const Robot *r, uint item) {
    uint moved = *r->moved;
    if (moved) mark_points(r, item);
    SYNC();
    if (moved) list_close_pairs(r, item);
    SYNC();
    if (moved && item == 0) *r->suspect = r->countable > 0 && 2 * *r->pairs > r->countable;
    SYNC();
}

// Finds the points inside tiles that are not theirs.
PART void find_insides(const Robot *r, uint item) {
    uint words = WORDS(r->points);
    EACH(n, r->tiles * words) {
        uint own = n / words, at = own * POINT_WORDS + n % words, bits = 0;
        uint near = r->near_points[at];
        if (near != 0) {
            Bounds bounds = tile_bounds(r, own);
            __global const ushort *corners = tile(r, own);
            for (; near != 0; near &= near - 1) {
                uint bit = 31 - clz(near & -near);
                double2 point = r->at[r->skin[32 * (n % words) + bit]];
                if (gap(bounds, at_point(point)) <= SLACK &&
                    is_inside(point, r->at[corners[0]], r->at[corners[1]], r->at[corners[2]], r->at[corners[3]])) {
                    bits |= 1u << bit;
                }
            }
        }
        r->inside[at] = bits;
        if (bits != 0) *r->any_inside = 1;
    }
}

// Counts the close pairs that overlap.
PART void count_overlaps(const Robot *r, uint item) {
    uint words = WORDS(r->tiles);
    EACH(n, r->tiles * words) {
        uint own = n / words, word = n % words;
        uint near = r->near_tiles[own * TILE_WORDS + word], count = 0;
        if (near != 0) {
            Bounds bounds = tile_bounds(r, own);
            for (; near != 0; near &= near - 1) {
                uint bit = 31 - clz(near & -near);
                if (overlap(bounds, tile_bounds(r, 32 * word + bit))) count++;
            }
            if (count != 0) atomic_add(r->pairs, count);
        }
    }
}

// The instability test: whether the ordered pairs of surface voxels that overlap and are not neighbors outnumber the
// surface voxels.
void test_stability(const Robot *r, uint item) {
    uint suspect = *r->suspect;
    if (suspect && item == 0) *r->pairs = 0;
    SYNC();
    if (suspect) count_overlaps(r, item);
    SYNC();
    if (suspect && item == 0) *r->unstable |= 2 * *r->pairs > r->countable;
}

// ---------------------------------------------------------------------------------------------------------------------
// The geometry of contact (docs/physics.md 7)

// A voxel at its current position, the corners clockwise from the top left, sides as bits: top, right, bottom, left.
typedef struct {
    double2 corner[4];
    uint sides;
    Bounds bounds;
} Quad;

// The surface side that a point came through, or none; its distance from that side's line, and the side's normal.
typedef struct {
    int side;
    double distance;
    double2 normal;
} Hit;

// A contact: the hit, and the masses that it pushes, the point's and those of the side's ends.
typedef struct {
    Hit hit;
    uint point;
    uint2 ends;
} Contact;

PART Quad robot_quad(const Robot *r, uint n) {
    __global const ushort *corners = tile(r, n);
    Quad quad;
    for (uint c = 0; c < 4; c++) quad.corner[c] = r->at[corners[c]];
    quad.sides = corners[TILE_SIDES];
    quad.bounds.least = fmin(fmin(fmin(quad.corner[0], quad.corner[1]), quad.corner[2]), quad.corner[3]);
    quad.bounds.greatest = fmax(fmax(fmax(quad.corner[0], quad.corner[1]), quad.corner[2]), quad.corner[3]);
    return quad;
}

// A ground voxel, rounded as in docs/physics.md 2.
Quad ground_quad(uint column, uint world_width) {
    double left = (double)column * CELL, right = (double)(column + 1) * CELL;
    Quad quad;
    quad.corner[0] = (double2)(left, CELL);
    quad.corner[1] = (double2)(right, CELL);
    quad.corner[2] = (double2)(right, 0.0);
    quad.corner[3] = (double2)(left, 0.0);
    quad.sides = 1u | (column + 1 == world_width ? 2u : 0u) | 4u | (column == 0 ? 8u : 0u);
    quad.bounds.least = quad.corner[3];
    quad.bounds.greatest = quad.corner[1];
    return quad;
}

bool is_surface(const Quad *quad, uint side) { return (quad->sides >> side & 1) != 0; }

// The corners of a side: clockwise on the surface, else left to right or top to bottom (docs/physics.md 3).
uint2 side_ends(const Quad *quad, uint side) {
    uint2 clockwise = (uint2)(side, (side + 1) % 4);
    return is_surface(quad, side) || side < 2 ? clockwise : clockwise.yx;
}

// Whether a point is so far outside that the inside test can be skipped. That test is true everywhere on the line of
// the falling diagonal, even far outside.
bool is_clear_of(const Quad *quad, double2 point) {
    double2 least = quad->bounds.least, greatest = quad->bounds.greatest;
    double clear = greatest.x - least.x < LARGE && greatest.y - least.y < LARGE ? CLEAR : INFINITY;
    bool outside = point.y > greatest.y + clear || point.y < least.y - clear || point.x < least.x - clear ||
                   point.x > greatest.x + clear;
    double2 start = quad->corner[0] - point, end = quad->corner[2] - point;
    return outside && fabs(end.x * start.y - end.y * start.x) > NEAR_DIAGONAL;
}

// Whether a quotient, rounded, is from 0 to 1. It is greater than 1 exactly if the one number is greater than the
// other, because the least number above the divisor gives a quotient beyond the middle between 1 and the number after
// it. So nothing is divided, except where the quotient could be rounded to zero, or is of numbers that are not
// finite.
bool is_share(double dividend, double divisor) {
    if (!(fabs(dividend) > 1e-150 && fabs(divisor) < 1e150)) {
        double share = dividend / divisor;
        return 0.0 <= share && share <= 1.0;
    }
    return fabs(dividend) <= fabs(divisor) && (dividend < 0.0) == (divisor < 0.0);
}

// Whether a side of the main voxel crosses a side of the reference; never when nearly parallel (docs/physics.md 7.3).
PART bool crosses(const Quad *main, uint own, const Quad *reference, uint side) {
    uint2 first = side_ends(main, own), second = side_ends(reference, side);
    double2 d1 = main->corner[first.y] - main->corner[first.x];
    double2 d2 = reference->corner[second.y] - reference->corner[second.x];
    double2 q = reference->corner[second.x] - main->corner[first.x];
    double det = -d1.x * d2.y + d2.x * d1.y;
    if (fabs(det) < PARALLEL) return false;
    return is_share(-d2.y * q.x + d2.x * q.y, det) && is_share(-d1.y * q.x + d1.x * q.y, det);
}

double distance_from(const Quad *quad, uint side, double2 point) {
    uint2 ends = side_ends(quad, side);
    double2 e = quad->corner[ends.y] - quad->corner[ends.x];
    double length = length_of(e);
    return length < SHORTEST ? NOWHERE : fabs(cross_product(e, point - quad->corner[ends.x])) / length;
}

// The contact of a corner of `main` with `reference` (docs/physics.md 7.2 to 7.4).
PART Hit hit_by(const Quad *reference, const Quad *main, uint corner) {
    Hit hit = { -1, 0.0, (double2)(0.0) };
    double2 point = main->corner[corner];
    if (is_clear_of(reference, point)) return hit;
    __private const double2 *c = reference->corner;
    if (!is_inside(point, c[0], c[1], c[2], c[3])) return hit;
    // The two sides at the corner, in the order in which they are tested: top and left, top and right, bottom and
    // right, bottom and left.
    uint own = corner < 2 ? 0 : 2, other = corner == 0 || corner == 3 ? 3 : 1;
    for (uint side = 0; side < 4; side++) {
        if (is_surface(reference, side) &&
            (crosses(main, own, reference, side) || crosses(main, other, reference, side))) {
            double distance = distance_from(reference, side, point);
            if (hit.side < 0 || distance < hit.distance) {
                hit.side = side;
                hit.distance = distance;
            }
        }
    }
    if (hit.side >= 0) {
        uint2 ends = side_ends(reference, hit.side);
        double2 e = reference->corner[ends.y] - reference->corner[ends.x];
        hit.normal = (double2)(-e.y, e.x) / length_of(e);
    }
    return hit;
}

// ---------------------------------------------------------------------------------------------------------------------
// Contact forces (docs/physics.md 7.5)

// The velocity over the last substep, including corrections (docs/physics.md 5).
double2 true_velocity(const Robot *r, uint mass) { return (r->at[mass] - r->before[mass]) / SUBSTEP; }

// Puts the forces of a contact, multiplied, into a place of the scratch: on the point and on each end of the side.
PART void push(const Robot *r, uint place, const Contact *contact, double times) {
    uint point = contact->point;
    double2 normal = contact->hit.normal;
    double strength = CONTACT_STIFFNESS * (CONTACT_DEPTH + contact->hit.distance);
    double2 force = strength * normal;
    double2 friction = (double2)(0.0);
    if (point != NONE) {
        double2 speed = true_velocity(r, point);
        double2 along = (double2)(-normal.y, normal.x);
        double range = FRICTION_RANGE * strength;
        friction = -FRICTION * range * hyperbolic_tangent(dot_product(along, speed) / range) * along;
        double2 damping = POINT_DAMPING * dot_product(normal, speed) * normal;
        r->scratch[3 * place] = (force - damping + friction) * times * PER_SUBSTEP_SQUARED;
    }
    r->target[3 * place] = point;
    uint end[2] = { contact->ends.x, contact->ends.y };
    for (uint n = 0; n < 2; n++) {
        if (end[n] != NONE) {
            double2 damping = EDGE_DAMPING * dot_product(normal, true_velocity(r, end[n])) * normal;
            r->scratch[3 * place + 1 + n] = (force / 2.0 + damping + friction / 2.0) * -times * PER_SUBSTEP_SQUARED;
        }
        r->target[3 * place + 1 + n] = end[n];
    }
}

// Contact of a low voxel with the ground: candidate `k` of its ground voxel is corner `k` of the voxel in the ground,
// or corner `k - 4` of the ground in the voxel.
PART Contact ground_contact(const Robot *r, uint candidate, uint columns, uint world_width) {
    uint low = candidate / 8 / columns, column = candidate / 8 % columns, corner = candidate % 8;
    Contact contact = { { -1, 0.0, (double2)(0.0) }, NONE, (uint2)(NONE) };
    if (column >= r->column_count[low]) return contact;
    Quad ground = ground_quad(r->first_column[low] + column, world_width);
    Quad quad = robot_quad(r, r->list[low]);
    __global const ushort *masses = tile(r, r->list[low]);
    contact.hit = corner < 4 ? hit_by(&ground, &quad, corner) : hit_by(&quad, &ground, corner - 4);
    if (corner < 4) {
        contact.point = masses[corner];
    } else if (contact.hit.side >= 0) {
        uint2 ends = side_ends(&quad, contact.hit.side);
        contact.ends = (uint2)(masses[ends.x], masses[ends.y]);
    }
    return contact;
}

// Contact of a point inside a tile: candidate `n` is the n-th surface voxel at the point.
PART Contact self_contact(const Robot *r, uint candidate) {
    uint reference = r->list[candidate / 4] >> 16, mass = r->list[candidate / 4] & 0xffff, n = candidate % 4;
    uint own = r->around[4 * mass + n];
    Contact contact = { { -1, 0.0, (double2)(0.0) }, mass, (uint2)(NONE) };
    if (own == NONE) return contact;
    uint corner = n == 0 ? 2 : n == 1 ? 3 : n == 2 ? 1 : 0;
    Quad quad = robot_quad(r, reference), main = robot_quad(r, own);
    if (!overlap(main.bounds, quad.bounds)) return contact;
    contact.hit = hit_by(&quad, &main, corner);
    if (contact.hit.side >= 0) {
        __global const ushort *masses = tile(r, reference);
        uint2 ends = side_ends(&quad, contact.hit.side);
        contact.ends = (uint2)(masses[ends.x], masses[ends.y]);
    }
    return contact;
}

// The set bits of some words before a place.
PART uint count_before(__local const uint *words, uint place) {
    uint bits = popcount(words[place / 32] & ((1u << place % 32) - 1));
    for (uint word = 0; word < place / 32; word++) bits += popcount(words[word]);
    return bits;
}

// The candidates of a robot: with `columns`, those of low voxels and the ground, else those of points inside tiles.
typedef struct {
    uint from, count, columns, world_width;
} Candidates;

PART void clear_hits(const Robot *r, uint item) {
    EACH(word, WORDS(TESTED)) r->hits[word] = 0;
}

// Finds out which of the first candidates are contacts. Each work-item keeps those that it found.
PART void test_candidates(const Robot *r, uint item, Candidates all, Contact *found) {
    for (uint own = 0; own < SHARE(TESTED); own++) {
        uint n = own * GROUP + item;
        if (n < min((uint)TESTED, all.count - all.from)) {
            uint candidate = all.from + n;
            found[own] = all.columns != 0 ? ground_contact(r, candidate, all.columns, all.world_width)
                                          : self_contact(r, candidate);
            if (found[own].hit.side >= 0) atomic_or(&r->hits[n / 32], 1u << n % 32);
        }
    }
}

PART uint count_bits(__local const uint *words, uint count) {
    uint bits = 0;
    for (uint word = 0; word < count; word++) bits += popcount(words[word]);
    return bits;
}

// Computes the forces of some contacts. Each contact of the robot with itself is evaluated twice.
PART void push_contacts(const Robot *r, uint item, uint columns, const Contact *found, uint done, uint pushed) {
    for (uint own = 0; own < SHARE(TESTED); own++) {
        uint n = own * GROUP + item;
        if (n < TESTED && (r->hits[n / 32] >> n % 32 & 1) != 0) {
            uint place = count_before(r->hits, n);
            if (done <= place && place < done + pushed) {
                push(r, place - done, &found[own], columns != 0 ? 1.0 : 2.0);
            }
        }
    }
}

// Adds their forces to the loads.
PART void add_loads(const Robot *r, uint item, uint pushed, double2 *load) {
    for (uint own = 0; own < MASS_SHARE; own++) {
        uint mass = own * GROUP + item;
        for (uint n = 0; n < 3 * pushed; n++) {
            if (r->target[n] == mass) load[own] += r->scratch[n];
        }
    }
}

// Tests candidates for a contact and adds the forces of the contacts to the loads, in order of the candidates.
void collide(const Robot *r, uint item, Candidates all, double2 *load) {
    Contact found[SHARE(TESTED)];
    do {
        clear_hits(r, item);
        SYNC();
        test_candidates(r, item, all, found);
        SYNC();
        uint contacts = count_bits(r->hits, WORDS(TESTED)), done = 0;
        do {
            uint pushed = min((uint)PUSHED, contacts - done);
            push_contacts(r, item, all.columns, found, done, pushed);
            SYNC();
            add_loads(r, item, pushed, load);
            SYNC();
            done += PUSHED;
        } while (done < contacts);
        all.from += TESTED;
    } while (all.from < all.count);
}

// Lists a low voxel with the ground voxels that its box overlaps or touches.
PART void list_low_tile(const Robot *r, uint n, uint world_width) {
    uint place = count_before(r->low, n);
    Quad quad = robot_quad(r, n);
    double2 least = quad.bounds.least, greatest = quad.bounds.greatest;
    uint from = 0, to = 0;
    if (least.y <= CELL && greatest.y >= 0.0 && least.x <= greatest.x) {
        double width = (double)world_width;
        from = (uint)fmin(fmax(floor(least.x / CELL) - 1.0, 0.0), width);
        to = (uint)fmin(fmax(floor(greatest.x / CELL) + 2.0, 0.0), width);
        while (from < to && !(least.x <= (double)(from + 1) * CELL)) from++;
        while (from < to && !((double)(to - 1) * CELL <= greatest.x)) to--;
    }
    r->list[place] = n;
    r->first_column[place] = from;
    r->column_count[place] = to - from;
    atomic_max(r->columns, to - from);
}

PART void list_low_tiles(const Robot *r, uint item, uint world_width) {
    // By the last work-items: the first ones find insides at the same time.
    for (uint n = GROUP - 1 - item; n < r->tiles; n += GROUP) {
        if ((r->low[n / 32] >> n % 32 & 1) != 0) list_low_tile(r, n, world_width);
    }
}

// Contact between the robot's low voxels and the ground, each way once.
void collide_with_ground(const Robot *r, uint item, uint world_width, double2 *load) {
    list_low_tiles(r, item, world_width);
    SYNC();
    uint columns = *r->columns;
    Candidates all = { 0, count_bits(r->low, TILE_WORDS) * columns * 8, columns, world_width };
    collide(r, item, all, load);
}

// The number of points inside tiles.
PART uint count_insides(const Robot *r) {
    uint all = 0;
    for (uint n = 0; n < r->tiles; n++) all += count_bits(r->inside + n * POINT_WORDS, WORDS(r->points));
    return all;
}

// Lists the points inside tiles from the one after the first `done`, by tile and then by point.
PART void list_insides(const Robot *r, uint item, uint done, uint count) {
    uint words = WORDS(r->points);
    EACH(n, count) {
        uint left = done + n, own = 0, word = 0, bits = r->inside[0];
        while (left >= popcount(bits)) {
            left -= popcount(bits);
            word++;
            if (word == words) {
                word = 0;
                own++;
            }
            bits = r->inside[own * POINT_WORDS + word];
        }
        for (; left > 0; left--) bits &= bits - 1;
        r->list[n] = own << 16 | r->skin[32 * word + 31 - clz(bits & -bits)];
    }
}

// Contact of the robot with itself. Each pair is evaluated twice in both orders, so the forces are doubled.
void collide_with_itself(const Robot *r, uint item, double2 *load) {
    uint insides = count_insides(r), done = 0;
    do {
        uint count = min((uint)TILES, insides - done);
        list_insides(r, item, done, count);
        SYNC();
        Candidates all = { 0, 4 * count, 0, 0 };
        collide(r, item, all, load);
        done += TILES;
    } while (done < insides);
}

// Contact forces and the instability test, both from the positions at the start of the substep.
void apply_contacts(const Robot *r, uint item, uint world_width, double2 *load) {
    for (uint own = 0; own < MASS_SHARE; own++) load[own] = (double2)(0.0, WEIGHT);
    survey(r, item);
    SYNC();
    WHEN(*r->moved) renew(r, item);
    find_insides(r, item);
    WHEN(*r->suspect) test_stability(r, item);
    WHEN(count_bits(r->low, TILE_WORDS) != 0) collide_with_ground(r, item, world_width, load);
    SYNC();
    WHEN(*r->any_inside) collide_with_itself(r, item, load);
    SYNC();
}

// ---------------------------------------------------------------------------------------------------------------------
// Springs and the integrator (docs/physics.md 6)

// A work-item's springs: their ends, stiffness, goals times the approach factor, and stiffness times frozen length.
typedef struct {
    uint ends[SPRING_SHARE];
    double stiffness[SPRING_SHARE];
    double aim[SPRING_SHARE];
    double frozen[SPRING_SHARE];
} Springs;

// A work-item's masses.
typedef struct {
    ushort8 gather[MASS_SHARE];
    double2 load[MASS_SHARE];
    double2 velocity[MASS_SHARE];
    double2 pace[MASS_SHARE];
    double2 sum[MASS_SHARE];
} Masses;

// The force of each spring on its later end: r k (d - l) / d. In the first stage d is also the length from which
// l = d + 0.006 (goal - d) is computed, so there it is r k (0.006 - 0.006 goal / d), and k l is kept.
PART void pull(const Robot *r, uint item, uint stage, Springs *springs) {
    __local const double2 *place = stage == 1 ? r->at : r->stage;
    for (uint own = 0; own < SPRING_SHARE; own++) {
        uint spring = own * GROUP + item;
        if (spring < r->springs) {
            double2 way = place[springs->ends[own] & 0xffff] - place[springs->ends[own] >> 16];
            double square = square_of(way);
            double inverse = reciprocal_root(square);
            double stiffness = springs->stiffness[own], aim = springs->aim[own], factor;
            if (stage == 1) {
                springs->frozen[own] = stiffness * (REST * (square * inverse) + aim);
                factor = stiffness * (APPROACH - aim * inverse);
            } else {
                factor = stiffness - springs->frozen[own] * inverse;
            }
            r->scratch[spring] = way * factor;
        }
    }
}

// Where the springs of a mass are; some place for those that it does not have. So all are read at once, and none waits
// for a test.
ushort8 places(ushort8 gather) {
    return select(gather, (ushort8)(0), gather == (ushort8)(NONE));
}

// The force on a mass: its load and the forces of its springs, in the order of the frames.
PART double2 gather_force(const Robot *r, ushort8 gather, double2 force) {
    __local const double2 *pull = r->scratch;
    ushort8 at = places(gather);
    double2 p0 = pull[at.s0], p1 = pull[at.s1], p2 = pull[at.s2], p3 = pull[at.s3], p4 = pull[at.s4 + 2];
    double2 p5 = pull[at.s5 + 1] + pull[at.s5 + 3], p6 = pull[at.s6] - pull[at.s6 + 3];
    double2 p7 = pull[at.s7] + (pull[at.s7 + 1] + pull[at.s7 + 2]);
    force = gather.s0 != NONE ? force + p0 : force;
    force = gather.s1 != NONE ? force + p1 : force;
    force = gather.s2 != NONE ? force - p2 : force;
    force = gather.s3 != NONE ? force - p3 : force;
    force = gather.s4 != NONE ? force + p4 : force;
    force = gather.s5 != NONE ? force + p5 : force;
    force = gather.s6 != NONE ? force + p6 : force;
    return gather.s7 != NONE ? force - p7 : force;
}

// The force of the plane y = 0 under the ground.
PART double2 plane(double2 force, double depth, double pace) {
    double normal = PLANE_STIFFNESS * depth;
    double speed = pace / SUBSTEP;
    double friction = PLANE_FRICTION * normal * hyperbolic_tangent(PLANE_SLOPE * normal * speed);
    return (double2)(force.x - friction * PER_SUBSTEP_SQUARED, force.y + normal * PER_SUBSTEP_SQUARED);
}

// Finishes a Runge-Kutta stage: adds drag and the plane's force, then advances the masses as `Mass::advance` does.
PART void finish_stage(const Robot *r, uint item, uint stage, Masses *masses) {
    for (uint own = 0; own < MASS_SHARE; own++) {
        uint mass = own * GROUP + item;
        if (mass < r->masses) {
            double2 force = gather_force(r, masses->gather[own], masses->load[own]);
            double2 at = r->at[mass], u = masses->velocity[own];
            double2 pace = stage == 1 ? u : masses->pace[own];
            double depth = -(stage == 1 ? at.y : r->stage[mass].y);
            if (depth > 0.0) force = plane(force, depth, pace.x);
            double2 a = force - DRAG * pace;
            if (stage == 1) {
                r->stage[mass] = at + 0.5 * u;
                masses->pace[own] = u + 0.5 * a;
            } else if (stage == 2) {
                r->stage[mass] = at + 0.5 * pace;
                masses->pace[own] = u + 0.5 * a;
                masses->sum[own] = pace + masses->pace[own];
            } else if (stage == 3) {
                double2 last = u + a;
                r->stage[mass] = at + pace;
                masses->pace[own] = last;
                r->before[mass] = at;
                r->at[mass] = at + SIXTH * ((u + last) + 2.0 * masses->sum[own]);
                masses->sum[own] = (masses->sum[own] + pace) + a;
            } else {
                masses->velocity[own] = SIXTH * (2.0 * masses->sum[own] + a);
            }
        }
    }
}

// ---------------------------------------------------------------------------------------------------------------------
// Length limits (docs/physics.md 8)

// The factor by which an edge's vector moves its ends if a limit is exceeded: share (d - bound) / (2 d), from d².
double correction(double square, double bound, double half_share) {
    double inverse = reciprocal_root(square);
    double excess = square * inverse - bound;
    return half_share * excess * inverse;
}

// Computes the shifts of all edges that are beyond a bound.
PART void measure_limits(const Robot *r, uint item, const Springs *springs) {
    for (uint own = 0; own < SPRING_SHARE; own++) {
        uint spring = own * GROUP + item;
        if (spring < r->springs) {
            double2 way = r->at[springs->ends[own] & 0xffff] - r->at[springs->ends[own] >> 16];
            double square = square_of(way);
            bool is_diagonal = spring % 4 >= 2 && spring < r->springs_in_frames;
            double most = is_diagonal ? DIAGONAL_MOST : MAIN_MOST, least = is_diagonal ? DIAGONAL_LEAST : MAIN_LEAST;
            bool too_long = most * most < square;
            double2 shift = (double2)(0.0);
            if (too_long || square < least * least) {
                shift = way * correction(square, too_long ? most : least, HALF_CORRECTION);
                *r->bites = 1;
            }
            r->scratch[spring] = shift;
        }
    }
}

// The sum of the shifts of a mass, in the order of the frames.
PART double2 gather_shifts(const Robot *r, ushort8 gather) {
    __local const double2 *shift = r->scratch;
    ushort8 at = places(gather);
    double2 s0 = shift[at.s0], s1 = shift[at.s1], s2 = shift[at.s2], s3 = shift[at.s3], s4 = shift[at.s4 + 2];
    double2 s51 = shift[at.s5 + 1], s53 = shift[at.s5 + 3], s60 = shift[at.s6], s63 = shift[at.s6 + 3];
    double2 s70 = shift[at.s7], s71 = shift[at.s7 + 1], s72 = shift[at.s7 + 2];
    double2 sum = (double2)(0.0);
    sum = gather.s0 != NONE ? sum + s0 : sum;
    sum = gather.s1 != NONE ? sum + s1 : sum;
    sum = gather.s2 != NONE ? sum - s2 : sum;
    sum = gather.s3 != NONE ? sum - s3 : sum;
    sum = gather.s4 != NONE ? sum + s4 : sum;
    sum = gather.s5 != NONE ? sum + s51 + s53 : sum;
    sum = gather.s6 != NONE ? sum + s60 - s63 : sum;
    return gather.s7 != NONE ? sum - s70 - s71 - s72 : sum;
}

PART void apply_limits(const Robot *r, uint item, const Masses *masses) {
    if (*r->bites) {
        for (uint own = 0; own < MASS_SHARE; own++) {
            uint mass = own * GROUP + item;
            if (mass < r->masses) r->at[mass] += gather_shifts(r, masses->gather[own]);
        }
    }
}

// First pass, all edges at once.
void limit_lengths(const Robot *r, uint item, const Springs *springs, const Masses *masses) {
    if (item == 0) *r->bites = *r->rigid_bites = 0;
    SYNC();
    measure_limits(r, item, springs);
    SYNC();
    apply_limits(r, item, masses);
    SYNC();
}

// Whether the length of a side of a rigid voxel is at or beyond a bound.
bool is_beyond(double2 from, double2 to) {
    double square = square_of(from - to);
    return (RIGID_MOST * RIGID_MOST <= square) | (square <= RIGID_LEAST * RIGID_LEAST);
}

bool has_side_beyond(double2 a, double2 b, double2 c, double2 d) {
    return is_beyond(a, b) | is_beyond(b, c) | is_beyond(c, d) | is_beyond(d, a);
}

// One side of a rigid voxel: moves its ends if it is at or beyond a bound.
void limit_side(double2 *from, double2 *to) {
    double2 way = *from - *to;
    double square = square_of(way);
    bool too_long = RIGID_MOST * RIGID_MOST <= square;
    if (too_long || square <= RIGID_LEAST * RIGID_LEAST) {
        double factor = correction(square, too_long ? RIGID_MOST : RIGID_LEAST, HALF_RIGID_CORRECTION);
        *from -= way * factor;
        *to += way * factor;
    }
}

PART void limit_voxels(const Robot *r, uint item, uint from, uint to) {
    for (uint voxel = from + item; voxel < to; voxel += GROUP) {
        __global const ushort *masses = r->rigid + 4 * voxel;
        double2 a = r->at[masses[0]], b = r->at[masses[1]], c = r->at[masses[2]], d = r->at[masses[3]];
        // Where no side is beyond a bound, no mass is moved. These tests do not wait for each other.
        if (has_side_beyond(a, b, c, d)) {
            limit_side(&a, &b);
            limit_side(&b, &c);
            limit_side(&c, &d);
            limit_side(&d, &a);
            r->at[masses[0]] = a;
            r->at[masses[1]] = b;
            r->at[masses[2]] = c;
            r->at[masses[3]] = d;
        }
    }
}

// Finds out whether a side of any rigid voxel is at or beyond a bound. If none is, the second pass changes nothing.
PART void measure_rigid(const Robot *r, uint item) {
    EACH(voxel, r->levels > 0 ? r->levels_end[r->levels - 1] : 0) {
        __global const ushort *masses = r->rigid + 4 * voxel;
        double2 a = r->at[masses[0]], b = r->at[masses[1]], c = r->at[masses[2]], d = r->at[masses[3]];
        if (has_side_beyond(a, b, c, d)) *r->rigid_bites = 1;
    }
}

// The sides of rigid voxels one after another. Voxels of one level have no mass in common, so they can be processed at
// the same time.
void limit_levels(const Robot *r, uint item) {
    uint level = 0, from = 0;
    do {
        uint to = *r->rigid_bites && level < r->levels ? r->levels_end[level] : from;
        limit_voxels(r, item, from, to);
        SYNC();
        from = to;
        level++;
    } while (level < r->levels);
}

// Second pass, the sides of rigid voxels.
void limit_rigid(const Robot *r, uint item) {
    measure_rigid(r, item);
    SYNC();
    WHEN(*r->rigid_bites) limit_levels(r, item);
}

// ---------------------------------------------------------------------------------------------------------------------
// Env steps

// The plan of a body.
PART void open_plan(Robot *r, __global const uint *body, __global const ushort *plan, __global const double *stiffness) {
    r->masses = body[BODY_MASSES];
    r->springs_in_frames = 4 * body[BODY_FRAMES];
    r->springs = r->springs_in_frames + body[BODY_RIMS];
    r->driven = body[BODY_DRIVEN];
    r->tiles = body[BODY_TILES];
    r->points = body[BODY_POINTS];
    r->levels = body[BODY_LEVELS];
    r->countable = body[BODY_COUNTABLE];
    r->stiffness = stiffness + body[BODY_STIFFNESS];
    r->ends = plan + body[BODY_PLAN];
    r->aims = r->ends + 2 * r->springs;
    r->gather = r->aims + r->springs;
    r->around = r->gather + 8 * r->masses;
    r->order = r->around + 4 * r->masses;
    r->owners = r->order + r->masses;
    r->surface = r->owners + 2 * r->driven;
    r->skin = r->surface + TILE_SIZE * r->tiles;
    r->levels_end = r->skin + r->points;
    r->rigid = r->levels_end + r->levels;
}

// The goals of the springs in an env step, times the approach factor (docs/physics.md 4).
PART void set_aims(const Robot *r, uint item, Springs *springs, __global const double *targets) {
    for (uint own = 0; own < SPRING_SHARE; own++) {
        uint spring = own * GROUP + item;
        if (spring < r->springs) {
            uint aim = r->aims[spring];
            double goal = aim == 1 ? DIAGONAL : CELL;
            if (aim >= 2) {
                double first = targets[r->owners[2 * aim - 4]];
                uint second = r->owners[2 * aim - 3];
                goal = second == NONE ? first * CELL : (first + targets[second]) * (CELL / 2.0);
            }
            springs->aim[own] = APPROACH * goal;
        }
    }
}

// One substep (docs/physics.md 5).
void substep(const Robot *r, uint item, uint world_width, Springs *springs, Masses *masses) {
    apply_contacts(r, item, world_width, masses->load);
    clear_survey(r, item);
    for (uint stage = 1; stage <= 4; stage++) {
        pull(r, item, stage, springs);
        SYNC();
        finish_stage(r, item, stage, masses);
        SYNC();
    }
    limit_lengths(r, item, springs, masses);
    limit_rigid(r, item);
}

// The center of mass in voxels: the plain mean over the points in order of creation.
PART double center(const Robot *r, uint axis) {
    double sum = 0.0;
    for (uint point = 0; point < r->masses; point++) {
        double2 at = r->at[r->order[point]];
        sum += axis == 0 ? at.x : at.y;
    }
    return sum / (double)r->masses / CELL;
}

// A robot's state in the device's memory, in order of its masses.
typedef struct {
    __global double2 *positions, *previous, *velocities;
} State;

PART void load_springs(const Robot *r, uint item, Springs *springs) {
    for (uint own = 0; own < SPRING_SHARE; own++) {
        uint spring = own * GROUP + item;
        if (spring < r->springs) {
            springs->ends[own] = r->ends[2 * spring] | (uint)r->ends[2 * spring + 1] << 16;
            springs->stiffness[own] = r->stiffness[spring];
        }
    }
}

PART void load_masses(const Robot *r, uint item, Masses *masses, const State *state) {
    for (uint own = 0; own < MASS_SHARE; own++) {
        uint mass = own * GROUP + item;
        if (mass < r->masses) {
            masses->gather[own] = vload8(mass, r->gather);
            masses->velocity[own] = state->velocities[mass];
            r->at[mass] = state->positions[mass];
            r->before[mass] = state->previous[mass];
            r->reference[mass] = (double2)(INFINITY);
        }
    }
}

PART void store_masses(const Robot *r, uint item, const Masses *masses, const State *state) {
    for (uint own = 0; own < MASS_SHARE; own++) {
        uint mass = own * GROUP + item;
        if (mass < r->masses) {
            state->positions[mass] = r->at[mass];
            state->previous[mass] = r->before[mass];
            state->velocities[mass] = masses->velocity[own];
        }
    }
}

// Simulates robots, one in each work-group. Centers of mass are written after each env step, `window` places for each
// robot; states are those after the last complete env step.
__kernel __attribute__((reqd_work_group_size(GROUP, 1, 1)))
void advance(__global const uint *robots, __global const uint *bodies, __global const ushort *plan,
             __global const double *stiffness, __global const double *targets, const uint channels,
             const uint world_width, const uint window, __global double2 *positions, __global double2 *previous,
             __global double2 *velocities, __global double2 *centers, __global uint2 *outcomes) {
    __local double2 at[MASSES], stage[MASSES], before[MASSES], reference[MASSES], scratch[SCRATCH];
    __local ushort target[3 * PUSHED];
    __local uint near_points[TILES * POINT_WORDS], inside[TILES * POINT_WORDS], near_tiles[TILES * TILE_WORDS];
    __local uint low[TILE_WORDS], hits[WORDS(TESTED)];
    __local uint list[TILES], first_column[TILES], column_count[TILES];
    __local uint moved, any_inside, pairs, suspect, unstable, columns, bites, rigid_bites;
    __local double mean[2];
    const uint item = get_local_id(0), number = get_group_id(0);
    __global const uint *robot = robots + ROBOT_WORDS * number;
    Robot own = { 0 };
    open_plan(&own, bodies + BODY_WORDS * robot[ROBOT_BODY], plan, stiffness);
    own.at = at;
    own.stage = stage;
    own.before = before;
    own.reference = reference;
    own.scratch = scratch;
    own.target = target;
    own.near_points = near_points;
    own.inside = inside;
    own.near_tiles = near_tiles;
    own.low = low;
    own.hits = hits;
    own.list = list;
    own.first_column = first_column;
    own.column_count = column_count;
    own.moved = &moved;
    own.any_inside = &any_inside;
    own.pairs = &pairs;
    own.suspect = &suspect;
    own.unstable = &unstable;
    own.columns = &columns;
    own.bites = &bites;
    own.rigid_bites = &rigid_bites;
    const Robot *r = &own;
    const uint first = robot[ROBOT_STATE];
    State state = { positions + first, previous + first, velocities + first };
    Springs springs;
    Masses masses;
    load_springs(r, item, &springs);
    load_masses(r, item, &masses, &state);
    if (item == 0) unstable = 0;
    clear_survey(r, item);
    SYNC();
    uint fault = SOUND, done = 0;
    do {
        set_aims(r, item, &springs, targets + robot[ROBOT_TARGETS] + done * channels);
        for (uint n = 0; n < SUBSTEPS; n++) substep(r, item, world_width, &springs, &masses);
        EACH(axis, 2) mean[axis] = center(r, axis);
        SYNC();
        double2 middle = (double2)(mean[0], mean[1]);
        fault = unstable ? UNSTABLE : isfinite(middle.x) && isfinite(middle.y) ? SOUND : NON_FINITE;
        if (fault == SOUND) {
            if (item == 0) centers[number * window + done] = middle;
            store_masses(r, item, &masses, &state);
            done++;
        }
        SYNC();
    } while (done < robot[ROBOT_STEPS] && fault == SOUND);
    if (item == 0) outcomes[number] = (uint2)(done, fault);
}
