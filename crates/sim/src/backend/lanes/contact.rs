//! The geometry of contact: which corners of a voxel are inside which other voxel, and which side they came through
//! (docs/physics.md 7).
//!
//! Ties at the start of a simulation are decided by the last bit here, so every formula is rounded as written.

use nalgebra::Vector2;

use crate::backend::lanes::real::{Mask, Real};
use crate::constants::Constants;
use crate::lattice::CORNERS;

/// A point farther than this outside the bounding box of a voxel, in meters, is outside the voxel for any rounding, ...
const CLEAR: f64 = 1e-5;

/// ... unless it is this close to the line of the falling diagonal: twice the area, in square meters, of the triangle
/// of the point and the diagonal.
const NEAR_DIAGONAL: f64 = 1e-7;

/// The bounding box is not used for voxels larger than this, in meters.
const SOUND: f64 = 1.0;

#[derive(Clone, Copy, Debug)]
pub struct Quad {
    pub corners: [Vector2<f64>; CORNERS],
    pub surface: [bool; CORNERS],
    pub bounds: [Vector2<f64>; 2],
    reach: [Vector2<f64>; 2],
    /// The ends of its top and its left side, if these are not between its corners.
    strays: Option<[[Vector2<f64>; 2]; 2]>,
}

/// A corner of one voxel inside another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    pub side: usize,
    /// Its distance from the line of that side, in meters.
    pub distance: f64,
    /// Unit normal of that side, outwards.
    pub normal: Vector2<f64>,
}

/// The two sides at each corner, in the order in which they are tested.
const MEETING: [[usize; 2]; CORNERS] = [[0, 3], [0, 1], [2, 1], [2, 3]];

/// In the triangle above its falling diagonal or in the one below (docs/physics.md 7.2).
#[inline(always)]
pub fn is_inside<R: Real>(point: [R; 2], corners: [[R; 2]; CORNERS]) -> R::Mask {
    let from = |corner: [R; 2]| [corner[0] - point[0], corner[1] - point[1]];
    let cross = |a: [R; 2], b: [R; 2]| a[0] * b[1] - a[1] * b[0];
    let [tl, tr, br, bl] = [from(corners[0]), from(corners[1]), from(corners[2]), from(corners[3])];
    let c = cross(br, tl);
    let agrees = |other: R| R::splat(0.0).at_most(c * other);
    let upper = agrees(cross(tl, tr)).and(agrees(cross(tr, br)));
    let lower = agrees(cross(tl, bl)).and(agrees(cross(bl, br)));
    upper.or(lower)
}

impl Quad {
    pub fn new(corners: [Vector2<f64>; CORNERS], surface: [bool; CORNERS]) -> Self {
        let [a, b, c, d] = corners;
        Self::within([a.inf(&b).inf(&c).inf(&d), a.sup(&b).sup(&c).sup(&d)], corners, surface)
    }

    pub fn within(bounds: [Vector2<f64>; 2], corners: [Vector2<f64>; CORNERS], surface: [bool; CORNERS]) -> Self {
        let [least, greatest] = bounds;
        let is_sound = greatest.x - least.x < SOUND && greatest.y - least.y < SOUND;
        let clear = Vector2::repeat(if is_sound { CLEAR } else { f64::INFINITY });
        Self { corners, surface, bounds, reach: [least - clear, greatest + clear], strays: None }
    }

    pub fn with_strays(self, strays: Option<[[Vector2<f64>; 2]; 2]>) -> Self {
        Self { strays, ..self }
    }

    /// The corners of a side: clockwise on the surface, else left to right or top to bottom (docs/physics.md 3).
    pub fn ends(&self, side: usize) -> [usize; 2] {
        let clockwise = [side, (side + 1) % CORNERS];
        if self.surface[side] || side < 2 { clockwise } else { [clockwise[1], clockwise[0]] }
    }

    fn segment(&self, side: usize) -> [Vector2<f64>; 2] {
        // A side at the surface is between its corners.
        if let Some([top, left]) = self.strays.filter(|_| side.is_multiple_of(3) && !self.surface[side]) {
            return if side == 0 { top } else { left };
        }
        self.ends(side).map(|corner| self.corners[corner])
    }

    /// [`Quad::contains`] is true everywhere on the line of the falling diagonal, even far outside.
    #[inline(always)]
    fn is_clear_of(&self, point: Vector2<f64>) -> bool {
        let [least, greatest] = self.reach;
        let is_outside = point.y > greatest.y || point.y < least.y || point.x < least.x || point.x > greatest.x;
        is_outside && {
            let (start, end) = (self.corners[0] - point, self.corners[2] - point);
            (end.x * start.y - end.y * start.x).abs() > NEAR_DIAGONAL
        }
    }

    pub fn contains(&self, point: Vector2<f64>) -> bool {
        is_inside([point.x, point.y], self.corners.map(|corner| [corner.x, corner.y]))
    }

    /// The contact of corner `corner` of `main` with this voxel, if it is inside and came through a surface side: the
    /// nearest of the surface sides crossed by one of the two sides at the corner (docs/physics.md 7.3 and 7.4).
    #[inline(always)]
    pub fn hit_by(&self, main: &Quad, corner: usize, constants: &Constants) -> Option<Hit> {
        let point = main.corners[corner];
        if self.is_clear_of(point) { None } else { self.hit_at(point, main, corner, constants) }
    }

    fn hit_at(&self, point: Vector2<f64>, main: &Quad, corner: usize, constants: &Constants) -> Option<Hit> {
        if !self.contains(point) {
            return None;
        }
        let mut nearest: Option<(usize, f64)> = None;
        for side in (0..CORNERS).filter(|&side| self.surface[side]) {
            let crossed = MEETING[corner].iter().any(|&own| crosses(main.segment(own), self.segment(side), constants));
            if crossed {
                let distance = distance(point, self.segment(side), constants);
                if nearest.is_none_or(|(_, least)| distance < least) {
                    nearest = Some((side, distance));
                }
            }
        }
        nearest.map(|(side, distance)| Hit { side, distance, normal: self.normal(side) })
    }

    /// The outward unit normal of a surface side: its direction turned by a quarter to the left.
    fn normal(&self, side: usize) -> Vector2<f64> {
        let [a, b] = self.segment(side);
        let e = b - a;
        Vector2::new(-e.y, e.x) / length(e)
    }
}

/// Whether a segment of the main voxel and one of the reference have a common point; never when nearly parallel.
fn crosses(first: [Vector2<f64>; 2], second: [Vector2<f64>; 2], constants: &Constants) -> bool {
    let (d1, d2) = (first[1] - first[0], second[1] - second[0]);
    let q = second[0] - first[0];
    let det = -d1.x * d2.y + d2.x * d1.y;
    if det.abs() < constants.parallel {
        return false;
    }
    let t = (-d2.y * q.x + d2.x * q.y) / det;
    let u = (-d1.y * q.x + d1.x * q.y) / det;
    (0.0..=1.0).contains(&t) && (0.0..=1.0).contains(&u)
}

fn distance(point: Vector2<f64>, [a, b]: [Vector2<f64>; 2], constants: &Constants) -> f64 {
    let e = b - a;
    let length = length(e);
    if length < constants.shortest { constants.nowhere } else { e.perp(&(point - a)).abs() / length }
}

fn length(e: Vector2<f64>) -> f64 {
    e.dot(&e).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn point(range: std::ops::Range<f64>) -> impl Strategy<Value = Vector2<f64>> {
        (range.clone(), range).prop_map(|(x, y)| Vector2::new(x, y))
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 4096, ..ProptestConfig::default() })]

        #[test]
        fn points_clear_of_a_voxel_are_not_inside(
            shifts in proptest::array::uniform4(point(-0.06..0.06)),
            beside in point(-0.2..0.3),
            far_along_the_diagonal in -3.0..3.0,
        ) {
            let square = [[0.0, 0.1], [0.1, 0.1], [0.1, 0.0], [0.0, 0.0]].map(|[x, y]| Vector2::new(x, y));
            let corners = [0, 1, 2, 3].map(|corner| square[corner] + shifts[corner]);
            let quad = Quad::new(corners, [true; CORNERS]);
            let on_the_diagonal = corners[0] + (corners[2] - corners[0]) * far_along_the_diagonal;
            for point in [beside, on_the_diagonal] {
                prop_assert!(!(quad.is_clear_of(point) && quad.contains(point)));
            }
        }
    }

    #[test]
    fn on_the_line_of_the_falling_diagonal_everything_is_inside() {
        let corners = [[0.0, 1.0], [1.0, 1.0], [1.0, 0.0], [0.0, 0.0]].map(|[x, y]| Vector2::new(x, y) / 8.0);
        let quad = Quad::new(corners, [true; CORNERS]);
        let (on, beside) = (Vector2::new(-0.125, 0.25), Vector2::new(-0.125, 0.26));
        assert!(quad.contains(on) && !quad.is_clear_of(on));
        assert!(!quad.contains(beside) && quad.is_clear_of(beside));
    }
}
