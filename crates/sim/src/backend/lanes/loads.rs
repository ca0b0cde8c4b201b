//! The loads of a batch's masses: gravity, and the contact forces of this substep.

use std::collections::BTreeSet;

use crate::backend::lanes::mass::{Mass, Vector};
use crate::backend::lanes::real::{Mask, Real};

/// The load of each mass, the same in all four stages of a substep.
#[derive(Debug)]
pub struct Loads<R: Real> {
    /// The load of each mass: an index of `values`.
    pub of_mass: Vec<u32>,
    /// Gravity for each set of lanes that occurs; then gravity and contact of each mass in contact.
    pub values: Vec<Vector<R>>,
    /// The number of `values` that are only gravity.
    weights: usize,
    /// Masses in contact, with their weight: an index of `values`.
    in_contact: Vec<(usize, u32)>,
}

impl<R: Real> Loads<R> {
    /// `lanes` has the lanes of each mass, as bits; `gravity` is in meters per substep squared.
    pub fn new(lanes: &[u32], gravity: f64) -> Self {
        let (zero, gravity) = (R::splat(0.0), R::splat(-gravity));
        let kinds: BTreeSet<u32> = lanes.iter().copied().collect();
        let kinds: Vec<u32> = kinds.into_iter().collect();
        let weight = |&kind: &u32| [zero, R::select(R::Mask::from_bits(kind), gravity, zero)];
        let kind = |lanes: &u32| kinds.binary_search(lanes).expect("each set of lanes is listed") as u32;
        Self {
            of_mass: lanes.iter().map(kind).collect(),
            values: kinds.iter().map(weight).collect(),
            weights: kinds.len(),
            in_contact: Vec::new(),
        }
    }

    #[inline(always)]
    pub fn of(&self, mass: usize) -> Vector<R> {
        self.values[self.of_mass[mass] as usize]
    }

    #[inline(always)]
    pub fn clear_contacts(&mut self, masses: &mut [Mass<R>]) {
        for (mass, weight) in self.in_contact.drain(..) {
            self.of_mass[mass] = weight;
            masses[mass].force = self.values[weight as usize];
        }
        self.values.truncate(self.weights);
    }

    /// Adds a force in meters per substep squared to a lane's mass for this substep.
    pub fn add(&mut self, lane: usize, mass: usize, force: [f64; 2]) {
        let weight = self.of_mass[mass];
        if (weight as usize) < self.weights {
            self.of_mass[mass] = self.values.len() as u32;
            self.values.push(self.values[weight as usize]);
            self.in_contact.push((mass, weight));
        }
        let load = &mut self.values[self.of_mass[mass] as usize];
        for axis in 0..2 {
            load[axis].set_lane(lane, load[axis].lane(lane) + force[axis]);
        }
    }
}
