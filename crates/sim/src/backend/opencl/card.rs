//! An OpenCL device: its memory, and the launch of the kernel.
//!
//! Only this file and `listing.rs` call the driver. The driver does not check its arguments, so the calls for memory
//! and kernels are `unsafe`. They are sound because buffers are created, filled and read here only, with the sizes of
//! the given slices.
#![allow(unsafe_code, reason = "calls of the driver's functions")]

use std::collections::BTreeMap;
use std::fmt;
use std::mem;
use std::ptr;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

use opencl3::command_queue::{CL_QUEUE_PROFILING_ENABLE, CommandQueue};
use opencl3::context::Context;
use opencl3::device::Device;
use opencl3::error_codes::{CL_INVALID_BUFFER_SIZE, CL_MEM_OBJECT_ALLOCATION_FAILURE, CL_OUT_OF_HOST_MEMORY, ClError};
use opencl3::kernel::Kernel;
use opencl3::memory::{Buffer, CL_MEM_READ_WRITE};
use opencl3::program::Program;
use opencl3::types::CL_BLOCKING;

use crate::backend::opencl::capacity::Capacity;
use crate::backend::opencl::error::DeviceError;
use crate::backend::opencl::listing::{DeviceKind, OpenClDevice};
use crate::constants::Constants;

/// The kernel's text.
const TEXT: &str = include_str!("step.cl");
const KERNEL: &str = "advance";

/// An open device with the compiled kernel.
pub struct Card {
    /// The device that is open.
    pub device: OpenClDevice,
    group: Option<usize>,
    /// The handles from the driver; `None` once the device is lost.
    handles: Mutex<Option<Handles>>,
    /// Whether the device is lost. Then no handle is released, because the driver may refuse this.
    lost: Arc<AtomicBool>,
}

/// The handles from the driver.
struct Handles {
    context: Context,
    queue: CommandQueue,
    /// The kernels compiled so far, with their programs.
    kernels: BTreeMap<Capacity, (Kernel, Program)>,
}

/// Types that the kernel reads and writes without conversion.
pub trait Plain: Copy + Default {}

impl Plain for u16 {}
impl Plain for u32 {}
impl Plain for f64 {}
impl Plain for [f64; 2] {}
impl Plain for [u32; 2] {}

/// Memory of a device.
#[derive(Debug)]
pub struct CardMemory<T: Plain> {
    buffer: Option<Buffer<T>>,
    count: usize,
    lost: Arc<AtomicBool>,
}

/// The arguments of a launch, as the kernel names them.
pub struct Arguments<'a> {
    /// Four words for each robot.
    pub robots: &'a CardMemory<u32>,
    /// The header of each body: where its lists are.
    pub bodies: &'a CardMemory<u32>,
    /// The lists of all bodies, one after another, as a `BodyPlan` has them.
    pub plan: &'a CardMemory<u16>,
    /// The stiffness of the springs of all bodies, in kilograms per substep squared.
    pub stiffness: &'a CardMemory<f64>,
    /// The targets of each material in each env step.
    pub targets: &'a CardMemory<f64>,
    /// The number of materials in a row of targets.
    pub codes: u32,
    /// Ground voxels in a row.
    pub world_width: u32,
    /// The most env steps of a robot.
    pub window: u32,
    /// The positions of masses, those one substep ago, and velocities.
    pub state: [&'a CardMemory<[f64; 2]>; 3],
    /// The centers of mass after each env step, in voxels.
    pub centers: &'a CardMemory<[f64; 2]>,
    /// Env steps done, and the fault.
    pub outcomes: &'a CardMemory<[u32; 2]>,
}

impl Card {
    /// Opens a device.
    ///
    /// # Errors
    /// When it has no doubles, or its driver fails.
    pub fn open(device: &OpenClDevice, group: Option<usize>) -> Result<Self, DeviceError> {
        if !device.has_doubles {
            return Err(DeviceError::NoDoubles { device: device.name.clone() });
        }
        let fault = |error: ClError| failure(&device.name, error);
        let context = Context::from_device(&Device::new(device.id())).map_err(fault)?;
        let queue = CommandQueue::create_default(&context, CL_QUEUE_PROFILING_ENABLE).map_err(fault)?;
        let handles = Some(Handles { context, queue, kernels: BTreeMap::new() });
        Ok(Self { device: device.clone(), group, handles: Mutex::new(handles), lost: Arc::default() })
    }

    /// The work-items of a robot's group.
    pub fn group(&self, capacity: Capacity) -> usize {
        let best = match self.device.kind {
            // A processor runs the work-items of a group one after another.
            DeviceKind::Processor => 1,
            DeviceKind::Graphics | DeviceKind::Other if capacity.springs <= 48 => 32,
            DeviceKind::Graphics | DeviceKind::Other if capacity.springs <= 128 => 64,
            DeviceKind::Graphics | DeviceKind::Other => 128,
        };
        self.group.unwrap_or(best).min(self.device.group_size)
    }

    /// Whether a robot of this capacity has room in the memory of a group.
    pub fn fits(&self, capacity: Capacity) -> bool {
        capacity.local_bytes() <= self.device.local_bytes
    }

    /// Copies numbers to the device.
    ///
    /// # Errors
    /// When there is no room, or the driver fails.
    pub fn upload<T: Plain>(&self, data: &[T]) -> Result<CardMemory<T>, DeviceError> {
        let mut memory = self.room(data.len().max(1))?;
        self.with(|handles| {
            if data.is_empty() {
                return Ok(());
            }
            // SAFETY: the buffer has room for the data, and the call ends when they are copied.
            let written = unsafe { handles.queue.enqueue_write_buffer(memory.buffer_mut(), CL_BLOCKING, 0, data, &[]) };
            written.map(drop)
        })?;
        Ok(memory)
    }

    /// Room for numbers on the device.
    ///
    /// # Errors
    /// When there is none, or the driver fails.
    pub fn room<T: Plain>(&self, count: usize) -> Result<CardMemory<T>, DeviceError> {
        self.with(|handles| {
            // SAFETY: the buffer has no memory of this process.
            let buffer = unsafe { Buffer::create(&handles.context, CL_MEM_READ_WRITE, count, ptr::null_mut()) }?;
            Ok(CardMemory { buffer: Some(buffer), count, lost: Arc::clone(&self.lost) })
        })
    }

    /// Copies numbers from the start of a memory of the device.
    ///
    /// # Errors
    /// When the driver fails.
    ///
    /// # Panics
    /// When the memory is smaller.
    pub fn read<T: Plain>(&self, memory: &CardMemory<T>, count: usize) -> Result<Vec<T>, DeviceError> {
        assert!(count <= memory.count, "a memory is read within its bounds");
        let mut data = vec![T::default(); count];
        if count == 0 {
            return Ok(data);
        }
        self.with(|handles| {
            // SAFETY: the buffer has as many numbers, every pattern of bits is one, and the call ends when they are
            // copied.
            let read = unsafe { handles.queue.enqueue_read_buffer(memory.buffer(), CL_BLOCKING, 0, &mut data, &[]) };
            read.map(drop)
        })?;
        Ok(data)
    }

    /// Simulates as many robots as groups, and returns the time in nanoseconds. The kernel is compiled if this is the
    /// first launch of its capacity.
    ///
    /// # Errors
    /// When the kernel cannot be compiled, or the driver fails.
    pub fn launch(
        &self,
        capacity: Capacity,
        constants: &Constants,
        groups: usize,
        arguments: &Arguments<'_>,
    ) -> Result<u64, DeviceError> {
        self.compile(capacity, constants)?;
        let group = self.group(capacity);
        let Arguments { robots, bodies, plan, stiffness, targets, state, centers, outcomes, .. } = arguments;
        self.with(|handles| {
            let kernel = &handles.kernels[&capacity].0;
            let (items, of_group) = ([groups * group], [group]);
            // SAFETY: the arguments are those of the kernel, in its order, and both sizes have one dimension. The
            // kernel stays within the buffers, because `DeviceRuns` makes the lists and the buffers from the same
            // plans.
            let event = unsafe {
                kernel.set_arg(0, robots.buffer())?;
                kernel.set_arg(1, bodies.buffer())?;
                kernel.set_arg(2, plan.buffer())?;
                kernel.set_arg(3, stiffness.buffer())?;
                kernel.set_arg(4, targets.buffer())?;
                kernel.set_arg(5, &arguments.codes)?;
                kernel.set_arg(6, &arguments.world_width)?;
                kernel.set_arg(7, &arguments.window)?;
                kernel.set_arg(8, state[0].buffer())?;
                kernel.set_arg(9, state[1].buffer())?;
                kernel.set_arg(10, state[2].buffer())?;
                kernel.set_arg(11, centers.buffer())?;
                kernel.set_arg(12, outcomes.buffer())?;
                let (items, of_group) = (items.as_ptr(), of_group.as_ptr());
                handles.queue.enqueue_nd_range_kernel(kernel.get(), 1, ptr::null(), items, of_group, &[])
            }?;
            event.wait()?;
            Ok(event.profiling_command_end()?.saturating_sub(event.profiling_command_start()?))
        })
    }

    /// Compiles the kernel of a capacity, unless it is there.
    fn compile(&self, capacity: Capacity, constants: &Constants) -> Result<(), DeviceError> {
        let mut guard = self.handles.lock().unwrap_or_else(PoisonError::into_inner);
        let Some(handles) = guard.as_mut() else { return Err(self.gone()) };
        if handles.kernels.contains_key(&capacity) {
            return Ok(());
        }
        let group = self.group(capacity);
        let text = capacity.prelude(group, constants) + TEXT;
        let rejected = |log: String| DeviceError::Rejected { device: self.device.name.clone(), log };
        let program = Program::create_and_build_from_source(&handles.context, &text, &self.options(group));
        let program = program.map_err(rejected)?;
        let kernel = Kernel::create(&program, KERNEL).map_err(|error| failure(&self.device.name, error))?;
        handles.kernels.insert(capacity, (kernel, program));
        Ok(())
    }

    /// The options of the compiler: nothing that changes how an operation is rounded.
    fn options(&self, group: usize) -> String {
        let mut options = "-cl-std=CL1.2".to_owned();
        options += match self.device.rounds_single {
            true => " -cl-fp32-correctly-rounded-divide-sqrt",
            false => " -DROUND_THROUGH_DOUBLE",
        };
        if group > 1 && self.device.kind == DeviceKind::Processor {
            options += " -DAPART";
        }
        options
    }

    /// Calls the driver. After an error other than one of memory, the device counts as lost.
    fn with<T>(&self, call: impl FnOnce(&Handles) -> Result<T, ClError>) -> Result<T, DeviceError> {
        let mut guard = self.handles.lock().unwrap_or_else(PoisonError::into_inner);
        let Some(handles) = guard.as_ref() else { return Err(self.gone()) };
        call(handles).map_err(|error| {
            let failure = failure(&self.device.name, error);
            if matches!(failure, DeviceError::Lost { .. }) {
                self.lost.store(true, Ordering::Relaxed);
                mem::forget(guard.take());
            }
            failure
        })
    }

    fn gone(&self) -> DeviceError {
        DeviceError::Lost { device: self.device.name.clone(), reason: "it failed before".to_owned() }
    }
}

impl fmt::Debug for Card {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Card").field("device", &self.device).finish_non_exhaustive()
    }
}

impl<T: Plain> CardMemory<T> {
    /// The numbers for which it has room.
    pub fn count(&self) -> usize {
        self.count
    }

    fn buffer(&self) -> &Buffer<T> {
        self.buffer.as_ref().expect("a memory has its buffer until it is dropped")
    }

    fn buffer_mut(&mut self) -> &mut Buffer<T> {
        self.buffer.as_mut().expect("a memory has its buffer until it is dropped")
    }
}

impl<T: Plain> Drop for CardMemory<T> {
    fn drop(&mut self) {
        if self.lost.load(Ordering::Relaxed) {
            mem::forget(self.buffer.take());
        }
    }
}

/// The error of a driver's function.
fn failure(device: &str, error: ClError) -> DeviceError {
    let device = device.to_owned();
    match error.0 {
        CL_MEM_OBJECT_ALLOCATION_FAILURE | CL_INVALID_BUFFER_SIZE | CL_OUT_OF_HOST_MEMORY => {
            DeviceError::OutOfMemory { device }
        }
        _ => DeviceError::Lost { device, reason: error.to_string() },
    }
}
