//! The native half of the Python package `nbc`: a door that calls the library through the names of its root. The other
//! half, in `python/nbc`, has the types and the documentation that users see.

mod bodies;
mod circuits;
mod command;
mod described;
mod errors;
mod evaluation;
mod evolution;
mod flock;
mod learning;
mod memory;
mod physics;
mod program;
mod scenes;
mod search;
mod slot;
mod swarm;
mod synthesis;
mod threads;
mod work;
mod worlds;

use pyo3::prelude::*;

#[pymodule(gil_used = true)]
fn _nbc(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    module.add("CYCLE_STEPS", nbc::CYCLE_STEPS)?;
    module.add_class::<circuits::Compiled>()?;
    module.add_class::<evolution::Evolution>()?;
    module.add_class::<flock::Flock>()?;
    module.add_class::<flock::FlockState>()?;
    module.add_class::<program::Program>()?;
    module.add_class::<scenes::Scenes>()?;
    module.add_class::<search::Candidates>()?;
    module.add_class::<search::Search>()?;
    module.add_class::<swarm::Swarm>()?;
    module.add_function(wrap_pyfunction!(bodies::draw_body, module)?)?;
    module.add_function(wrap_pyfunction!(bodies::invalid_bodies, module)?)?;
    module.add_function(wrap_pyfunction!(bodies::paper_materials, module)?)?;
    module.add_function(wrap_pyfunction!(bodies::robots, module)?)?;
    module.add_function(wrap_pyfunction!(bodies::verify, module)?)?;
    module.add_function(wrap_pyfunction!(bodies::three_materials, module)?)?;
    module.add_function(wrap_pyfunction!(command::program, module)?)?;
    module.add_function(wrap_pyfunction!(errors::nearest, module)?)?;
    module.add_function(wrap_pyfunction!(evaluation::evaluate, module)?)?;
    module.add_function(wrap_pyfunction!(learning::learn, module)?)?;
    module.add_function(wrap_pyfunction!(program::write_file, module)?)?;
    module.add_function(wrap_pyfunction!(physics::read_schedule, module)?)?;
    module.add_function(wrap_pyfunction!(physics::simulate, module)?)?;
    module.add_function(wrap_pyfunction!(search::read_checkpoint, module)?)?;
    module.add_function(wrap_pyfunction!(synthesis::synthesize, module)?)?;
    module.add_function(wrap_pyfunction!(threads::most_threads, module)?)?;
    module.add_function(wrap_pyfunction!(threads::set_threads, module)?)?;
    Ok(())
}
