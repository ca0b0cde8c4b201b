//! Contact with terrain (docs/physics.md 7 and 16): which voxels are close to it, and the forces.

use std::sync::Arc;

use nalgebra::Vector2;

use crate::backend::lanes::batch::{Batch, Floor};
use crate::backend::lanes::contact::Quad;
use crate::backend::lanes::proximity::{MARGIN, NearTerrain, SLACK, bounds};
use crate::backend::lanes::real::{Mask, Real};
use crate::backend::lanes::stiffness::Stiffness;
use crate::lattice::CORNERS;
use crate::terrain::Terrain;

impl<R: Real, K: Stiffness<R>> Batch<R, K> {
    pub fn renew_terrain(&mut self, terrain: &Terrain) {
        let (near, cell) = (&mut self.touching.near, self.constants.cell);
        near.clear();
        let mut found: Vec<(usize, u32)> = Vec::new();
        for (n, tile) in self.proximity.tiles.iter().enumerate() {
            let [least, greatest] = bounds(&self.masses.now, tile);
            for lane in (0..self.occupants.len()).filter(|lane| tile.surface >> lane & 1 == 1) {
                let least = least.map(|axis| axis.lane(lane) - MARGIN - SLACK);
                let greatest = greatest.map(|axis| axis.lane(lane) + MARGIN + SLACK);
                terrain.each_near(least, greatest, cell, |voxel| found.push((voxel, 1 << lane)));
            }
            found.sort_unstable();
            for of_voxel in found.chunk_by(|one, other| one.0 == other.0) {
                let lanes = of_voxel.iter().fold(0, |all, (_, lane)| all | lane);
                near.push(NearTerrain { tile: n, voxel: of_voxel[0].0, lanes });
            }
            found.clear();
        }
    }

    #[inline(always)]
    pub fn collide_with_terrain(&mut self) {
        let Floor::Terrain(terrain) = &self.floor else { return };
        let terrain = Arc::clone(terrain);
        let near = std::mem::take(&mut self.touching.near);
        let mut last = None;
        let mut reach = [[R::splat(0.0); 2]; 2];
        for pair in &near {
            if last != Some(pair.tile) {
                reach = bounds(&self.masses.now, &self.proximity.tiles[pair.tile]);
                last = Some(pair.tile);
            }
            let corners = &terrain.voxels[pair.voxel].corners;
            let x = R::splat(corners[3].x).at_most(reach[1][0]).and(reach[0][0].at_most(R::splat(corners[1].x)));
            let y = R::splat(corners[3].y).at_most(reach[1][1]).and(reach[0][1].at_most(R::splat(corners[1].y)));
            let lanes = x.and(y).bits() & pair.lanes;
            if lanes != 0 {
                self.collide_voxel_with_terrain(pair, lanes, &terrain);
            }
        }
        self.touching.near = near;
    }

    #[inline(never)]
    fn collide_voxel_with_terrain(&mut self, pair: &NearTerrain, lanes: u32, terrain: &Terrain) {
        let fixed = &terrain.voxels[pair.voxel];
        let bounds: [Vector2<f64>; 2] = [fixed.corners[3], fixed.corners[1]];
        let fixed = Quad::within(bounds, fixed.corners, fixed.surface);
        for lane in self.sound_lanes(lanes) {
            let voxel = self.proximity.tiles[pair.tile].in_lane[lane];
            let (quad, masses) = self.quad(lane, voxel);
            self.collide_with_fixed(lane, &quad, &masses, &fixed);
        }
    }

    pub fn collide_with_fixed(&mut self, lane: usize, quad: &Quad, masses: &[usize; CORNERS], fixed: &Quad) {
        for corner in 0..CORNERS {
            if let Some(hit) = fixed.hit_by(quad, corner, &self.constants) {
                self.push(lane, &hit, Some(masses[corner]), None, 1.0);
            }
        }
        for corner in 0..CORNERS {
            if let Some(hit) = quad.hit_by(fixed, corner, &self.constants) {
                let ends = quad.ends(hit.side).map(|corner| masses[corner]);
                self.push(lane, &hit, None, Some(ends), 1.0);
            }
        }
    }
}
