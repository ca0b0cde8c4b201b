//! What Evolution Gym's environments observe of a scene (docs/physics.md 16). Sums and differences are rounded as
//! there: a column of terrain may end exactly at the middle of a symmetric robot, so the last bit matters.

use crate::constants::Constants;
use crate::scene::Scene;
use crate::state::State;

/// Means over the points of an object, which are added one after another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ObjectCenter {
    /// The center of mass, in voxels.
    pub place: [f64; 2],
    pub place_in_meters: [f64; 2],
    /// The mean velocity, in voxels per second.
    pub velocity: [f64; 2],
    pub velocity_in_meters: [f64; 2],
}

/// Columns of terrain around the center of mass of an object, each as wide as a voxel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sight {
    pub columns: usize,
    /// The farthest that is seen, in voxels.
    pub reach: f64,
    pub is_above: bool,
}

impl Scene {
    pub fn center(&self, object: usize, state: &State, constants: &Constants) -> ObjectCenter {
        let (places, velocities) =
            (self.positions(object, state, constants), self.velocities(object, state, constants));
        let mean = |values: &[[f64; 2]], unit: f64| {
            let sum = |axis: usize| values.iter().fold(0.0, |sum, value| sum + value[axis] * unit);
            [sum(0), sum(1)].map(|sum| sum / values.len() as f64)
        };
        ObjectCenter {
            place: mean(&places, 1.0),
            place_in_meters: mean(&places, constants.cell),
            velocity: mean(&velocities, 1.0),
            velocity_in_meters: mean(&velocities, constants.cell),
        }
    }

    /// Distances below (or above) an object's center of mass, in voxels; the farthest that is seen without terrain.
    pub fn surface(
        &self,
        object: usize,
        terrain: &[usize],
        sight: &Sight,
        state: &State,
        constants: &Constants,
    ) -> Vec<f64> {
        let Sight { columns, reach, is_above } = *sight;
        let [x, y] = self.center(object, state, constants).place;
        let end = columns as f64;
        let none = if is_above { reach + y } else { -reach + y };
        let mut found: Vec<Option<f64>> = vec![None; 2 * columns + 1];
        let mut see = |[left, high]: [f64; 2]| {
            if if is_above { high > y } else { high < y } {
                let nearest = (left - x).round();
                for column in [nearest - 1.0, nearest, nearest + 1.0] {
                    let is_in = left > x + (column - 0.5) && left < x + (column + 0.5);
                    if is_in && column.abs() <= end {
                        let best = &mut found[(column + end) as usize];
                        let is_nearer = |&best: &f64| if is_above { high < best } else { high > best };
                        *best = if best.as_ref().is_none_or(is_nearer) { Some(high) } else { *best };
                    }
                }
            }
        };
        for &object in terrain {
            match self.still_by_column(object) {
                Some(points) => {
                    let from = points.partition_point(|point| point[0] <= x + (-end - 0.5));
                    points[from..].iter().take_while(|point| point[0] < x + (end + 0.5)).for_each(|&at| see(at));
                }
                None => self.positions(object, state, constants).into_iter().for_each(&mut see),
            }
        }
        let distance = |high: Option<f64>| {
            let high = high.unwrap_or(none);
            (if is_above { high - y } else { y - high }).max(0.0).min(reach)
        };
        found.into_iter().map(distance).collect()
    }

    /// The width and the height of an object, and the area of the convex hull of its points, in voxels.
    pub fn extent(&self, object: usize, state: &State, constants: &Constants) -> [f64; 3] {
        let mut points = self.positions(object, state, constants);
        let span = |axis: usize| {
            let values = points.iter().map(|point| point[axis]);
            values.clone().fold(f64::NEG_INFINITY, f64::max) - values.fold(f64::INFINITY, f64::min)
        };
        let (width, height) = (span(0), span(1));
        points.sort_unstable_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
        [width, height, hull_area(&points)]
    }
}

/// The area of the convex hull of points that are sorted by x and then by y: the lower half, then the upper half.
fn hull_area(points: &[[f64; 2]]) -> f64 {
    let mut hull: Vec<[f64; 2]> = Vec::new();
    let mut extend = |points: &mut dyn Iterator<Item = &[f64; 2]>| {
        let first = hull.len();
        for &point in points {
            while hull.len() > first + 1 && !turns_left(hull[hull.len() - 2], hull[hull.len() - 1], point) {
                hull.pop();
            }
            hull.push(point);
        }
        // It is the first of the next half.
        hull.pop();
    };
    extend(&mut points.iter());
    extend(&mut points.iter().rev());
    let following = hull.iter().cycle().skip(1);
    hull.iter().zip(following).fold(0.0, |sum, (a, b)| sum + (a[0] * b[1] - b[0] * a[1])) / 2.0
}

fn turns_left(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> bool {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) > 0.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::grid::Grid;
    use crate::scene::SceneObject;

    fn scene() -> (Scene, Constants) {
        let constants = Constants::default();
        let object = |width: usize, codes: &[u8], at: [usize; 2]| {
            let grid = Grid::structure(width, codes.len() / width, codes);
            SceneObject { grid, at }
        };
        // A robot, the ground, a roof, and a ledge that hangs on a fixed voxel.
        let objects = [
            object(2, &[3, 3, 4, 0], [4, 1]),
            object(12, &[5; 12], [0, 0]),
            object(3, &[5; 3], [4, 7]),
            object(3, &[5, 2, 2], [6, 4]),
        ];
        (Scene::new(&objects, &constants), constants)
    }

    #[test]
    fn centers_are_means_of_points() {
        let (scene, constants) = scene();
        let mut state = scene.start.clone();
        state.velocity.iter_mut().for_each(|velocity| *velocity = [0.1 * constants.substep, 0.0]);
        let center = scene.center(0, &state, &constants);
        let points = [[4.0, 3.0], [5.0, 3.0], [4.0, 2.0], [5.0, 2.0], [6.0, 3.0], [6.0, 2.0], [4.0, 1.0], [5.0, 1.0]];
        let mean = |axis: usize| points.iter().map(|point| point[axis]).sum::<f64>() / 8.0;
        for axis in 0..2 {
            assert!((center.place[axis] - mean(axis)).abs() < 1e-12);
            assert!((center.place_in_meters[axis] - mean(axis) / 10.0).abs() < 1e-12);
        }
        assert!((center.velocity[0] - 1.0).abs() < 1e-12 && (center.velocity_in_meters[0] - 0.1).abs() < 1e-12);
        assert_eq!(scene.center(1, &state, &constants).velocity, [0.0; 2]);
    }

    #[test]
    fn terrain_is_seen_in_columns() {
        let (scene, constants) = scene();
        let [_, y] = scene.center(0, &scene.start, &constants).place;
        let see = |terrain: &[usize], columns: usize, reach: f64, is_above: bool| {
            scene.surface(0, terrain, &Sight { columns, reach, is_above }, &scene.start, &constants)
        };
        let near = |found: &[f64], expected: &[f64]| {
            found.len() == expected.len() && found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-12)
        };
        // The middle of the robot is at 4.875; that of the first column at 2.875, of the last at 6.875.
        assert!(near(&see(&[1], 2, 5.0, false), &[y - 1.0; 5]));
        assert!(near(&see(&[2], 3, 9.0, true), &[9.0, 9.0, 7.0 - y, 7.0 - y, 7.0 - y, 7.0 - y, 9.0]));
        assert!(near(&see(&[2, 3], 3, 9.0, true), &[9.0, 9.0, 7.0 - y, 7.0 - y, 4.0 - y, 4.0 - y, 4.0 - y]));
        assert!(near(&see(&[1, 2], 1, 0.5, false), &[0.5; 3]));
        assert!(near(&see(&[], 1, 5.0, false), &[5.0; 3]));
    }

    #[test]
    fn extents_have_the_area_of_the_hull() {
        let (scene, constants) = scene();
        let found = scene.extent(0, &scene.start, &constants);
        for (found, expected) in found.into_iter().zip([2.0, 2.0, 3.5]) {
            assert!((found - expected).abs() < 1e-12, "{found} is not {expected}");
        }
        let area = |points: &[[f64; 2]]| hull_area(points);
        assert_eq!(area(&[[0.0, 0.0], [0.0, 1.0], [0.5, 0.5], [1.0, 0.0], [1.0, 1.0]]), 1.0);
        assert_eq!((area(&[[0.0, 0.0], [1.0, 1.0], [2.0, 2.0]]), area(&[[1.0, 1.0]]), area(&[])), (0.0, 0.0, 0.0));
    }
}
