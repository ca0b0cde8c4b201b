//! Work shared among the threads of the machine with the feature `parallel`; results do not depend on it.

#[cfg(feature = "parallel")]
use rayon::prelude::*;

/// With fewer runs than this in a batch, lanes of the kernel would be idle, so threads do not split them further.
const LEAST_LANES: usize = 4;

#[cfg(feature = "parallel")]
pub fn count() -> usize {
    rayon::current_num_threads()
}

#[cfg(not(feature = "parallel"))]
pub fn count() -> usize {
    1
}

/// Does the work for each item, in any order.
#[cfg(feature = "parallel")]
pub fn for_each<T: Send>(items: &mut [T], work: impl Fn(&mut T) + Sync + Send) {
    match items {
        // The caller's thread would only wait for another.
        [item] => work(item),
        items => items.par_iter_mut().with_max_len(1).for_each(work),
    }
}

#[cfg(not(feature = "parallel"))]
pub fn for_each<T: Send>(items: &mut [T], work: impl Fn(&mut T) + Sync + Send) {
    items.iter_mut().for_each(work);
}

pub fn lanes_for(runs: usize, lanes: usize) -> usize {
    runs.div_ceil(count()).max(LEAST_LANES).min(lanes)
}
