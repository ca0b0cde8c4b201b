//! An OpenCL device: its memory, and the launch of the kernel.
//!
//! Only this file and `listing.rs` call the driver. The driver does not check its arguments, so the calls for memory
//! and kernels are `unsafe`. They are sound because buffers are created, filled and read here only, with the sizes of
//! the given slices.
#![allow(unsafe_code, reason = "calls of the driver's functions")]

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use std::fmt;
use std::marker::PhantomData;
use std::mem;
use std::ptr;
use std::slice;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

use opencl3::command_queue::CommandQueue;
use opencl3::context::Context;
use opencl3::device::Device;
use opencl3::error_codes::{CL_INVALID_BUFFER_SIZE, CL_MEM_OBJECT_ALLOCATION_FAILURE, CL_OUT_OF_HOST_MEMORY, ClError};
use opencl3::event::{CL_COMPLETE, Event};
use opencl3::kernel::Kernel;
use opencl3::memory::{Buffer, CL_MEM_READ_WRITE};
use opencl3::program::Program;
use opencl3::types::CL_BLOCKING;

use crate::backend::opencl::capacity::Capacity;
use crate::backend::opencl::error::DeviceError;
use crate::backend::opencl::listing::{DeviceKind, OpenClDevice};
use crate::constants::Constants;

const TEXT: &str = include_str!("step.cl");
const KERNEL: &str = "advance";
const PRESENT: &str = "a queue has its commands until it is dropped";

/// Robots so few that no other needs their multiprocessor. Larger groups were faster with up to 64 (docs/gpu.md).
const FEW: usize = 16;

/// How often a caller asks whether a launch is done, which may take 200 ms. A driver's own wait may keep a core busy.
const POLL: Duration = Duration::from_micros(300);

type KernelSize = (Capacity, usize);

pub struct Card {
    pub device: OpenClDevice,
    group: Option<usize>,
    handles: Mutex<Handles>,
    storage: Arc<Storage>,
}

struct Handles {
    context: Arc<Context>,
    programs: BTreeMap<KernelSize, Program>,
    spare: Vec<Commands>,
}

/// A queue of commands, and the kernels that are launched on it: a kernel has one set of arguments at a time.
struct Commands {
    context: Arc<Context>,
    queue: CommandQueue,
    kernels: BTreeMap<KernelSize, Kernel>,
}

pub struct CardQueue<'a> {
    card: &'a Card,
    /// Present until this is dropped.
    commands: Option<Commands>,
}

/// A type without padding for which every pattern of bits is a value.
pub trait Plain: Copy + Default {}

impl Plain for u16 {}
impl Plain for u32 {}
impl Plain for f64 {}
impl Plain for [f64; 2] {}
impl Plain for [u32; 2] {}

#[derive(Debug)]
pub struct CardMemory<T: Plain> {
    buffer: Option<Buffer<u8>>,
    count: usize,
    storage: Arc<Storage>,
    numbers: PhantomData<T>,
}

/// By size. To release memory, a driver may wait for the commands of all callers, so it is kept for the next one.
#[derive(Debug, Default)]
struct Storage {
    spare: Mutex<BTreeMap<usize, Vec<Buffer<u8>>>>,
    /// Whether the device is lost. Then no handle is released, because the driver may refuse this.
    lost: AtomicBool,
}

pub struct Arguments<'a> {
    pub robots: &'a CardMemory<u32>,
    pub bodies: &'a CardMemory<u32>,
    /// The lists of all bodies, one after another, as a `BodyPlan` has them.
    pub plan: &'a CardMemory<u16>,
    /// The stiffness of the springs of all bodies, in kilograms per substep squared.
    pub stiffness: &'a CardMemory<f64>,
    pub targets: &'a CardMemory<f64>,
    pub channels: u32,
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
    pub fn open(device: &OpenClDevice, group: Option<usize>) -> Result<Self, DeviceError> {
        if !device.has_doubles {
            return Err(DeviceError::NoDoubles { device: device.name.clone() });
        }
        let context = Context::from_device(&Device::new(device.id())).map_err(|error| failure(&device.name, error))?;
        let handles = Handles { context: Arc::new(context), programs: BTreeMap::new(), spare: Vec::new() };
        Ok(Self { device: device.clone(), group, handles: Mutex::new(handles), storage: Arc::default() })
    }

    fn group(&self, capacity: Capacity, robots: usize) -> usize {
        let best = match self.device.kind {
            // A processor runs the work-items of a group one after another.
            DeviceKind::Processor => 1,
            DeviceKind::Graphics | DeviceKind::Other if capacity.springs <= 48 => 32,
            // A robot has a multiprocessor for itself, so it may have an item for each of its springs.
            DeviceKind::Graphics | DeviceKind::Other if capacity.springs > 128 && robots <= FEW => 256,
            DeviceKind::Graphics | DeviceKind::Other => 128,
        };
        self.group.unwrap_or(best).min(self.device.group_size)
    }

    pub fn fits(&self, capacity: Capacity) -> bool {
        capacity.local_bytes() <= self.device.local_bytes
    }

    pub fn queue(&self) -> Result<CardQueue<'_>, DeviceError> {
        self.check()?;
        let mut handles = self.lock();
        let spare = handles.spare.pop();
        let commands = spare.map_or_else(|| Commands::new(&handles.context), Ok).map_err(|error| self.fail(error))?;
        Ok(CardQueue { card: self, commands: Some(commands) })
    }

    fn kernel(&self, size: KernelSize, constants: &Constants) -> Result<Kernel, DeviceError> {
        let mut handles = self.lock();
        let Handles { context, programs, .. } = &mut *handles;
        let program = match programs.entry(size) {
            Entry::Occupied(place) => place.into_mut(),
            Entry::Vacant(place) => {
                let (capacity, group) = size;
                let text = capacity.prelude(group, constants) + TEXT;
                let rejected = |log: String| DeviceError::Rejected { device: self.device.name.clone(), log };
                let program = Program::create_and_build_from_source(context, &text, &self.options(group));
                place.insert(program.map_err(rejected)?)
            }
        };
        Kernel::create(program, KERNEL).map_err(|error| self.fail(error))
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

    /// After an error other than of memory, the device counts as lost.
    fn fail(&self, error: ClError) -> DeviceError {
        let failure = failure(&self.device.name, error);
        if matches!(failure, DeviceError::Lost { .. }) {
            self.storage.lost.store(true, Ordering::Relaxed);
        }
        failure
    }

    fn check(&self) -> Result<(), DeviceError> {
        let gone = || DeviceError::Lost { device: self.device.name.clone(), reason: "it failed before".to_owned() };
        if self.is_lost() { Err(gone()) } else { Ok(()) }
    }

    fn is_lost(&self) -> bool {
        self.storage.is_lost()
    }

    fn lock(&self) -> MutexGuard<'_, Handles> {
        self.handles.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl fmt::Debug for Card {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Card").field("device", &self.device).finish_non_exhaustive()
    }
}

impl Drop for Card {
    fn drop(&mut self) {
        if self.is_lost() {
            let mut handles = self.lock();
            mem::forget(Arc::clone(&handles.context));
            mem::forget((mem::take(&mut handles.programs), mem::take(&mut handles.spare)));
        }
    }
}

impl Commands {
    fn new(context: &Arc<Context>) -> Result<Self, ClError> {
        let queue = CommandQueue::create_default(context, 0)?;
        Ok(Self { context: Arc::clone(context), queue, kernels: BTreeMap::new() })
    }
}

impl CardQueue<'_> {
    pub fn upload<T: Plain>(&self, data: &[T]) -> Result<CardMemory<T>, DeviceError> {
        let mut memory = self.room(data.len().max(1))?;
        self.with(|commands| {
            if data.is_empty() {
                return Ok(());
            }
            // SAFETY: `Plain` types have no padding.
            let bytes = unsafe { slice::from_raw_parts(data.as_ptr().cast::<u8>(), size_of_val(data)) };
            // SAFETY: the buffer has room for the data, and the call ends when they are copied.
            unsafe { commands.queue.enqueue_write_buffer(memory.buffer_mut(), CL_BLOCKING, 0, bytes, &[]) }.map(drop)
        })?;
        Ok(memory)
    }

    pub fn room<T: Plain>(&self, count: usize) -> Result<CardMemory<T>, DeviceError> {
        let bytes = CardMemory::<T>::bytes(count);
        let storage = &self.card.storage;
        let create = |commands: &Commands| {
            // SAFETY: the buffer has no memory of this process.
            unsafe { Buffer::create(&commands.context, CL_MEM_READ_WRITE, bytes, ptr::null_mut()) }
        };
        let buffer = match storage.take(bytes) {
            Some(buffer) => buffer,
            None => self.with(|commands| {
                create(commands).or_else(|_| {
                    storage.release();
                    create(commands)
                })
            })?,
        };
        Ok(CardMemory { buffer: Some(buffer), count, storage: Arc::clone(storage), numbers: PhantomData })
    }

    pub fn read<T: Plain>(&self, memory: &CardMemory<T>, count: usize) -> Result<Vec<T>, DeviceError> {
        assert!(count <= memory.count, "a memory is read within its bounds");
        let mut data = vec![T::default(); count];
        if count == 0 {
            return Ok(data);
        }
        // SAFETY: `Plain` types have no padding, and every pattern of bits is one of their values.
        let bytes = unsafe { slice::from_raw_parts_mut(data.as_mut_ptr().cast::<u8>(), size_of_val(&*data)) };
        self.with(|commands| {
            // SAFETY: the buffer has as many bytes, and the call ends when they are copied.
            unsafe { commands.queue.enqueue_read_buffer(memory.buffer(), CL_BLOCKING, 0, bytes, &[]) }.map(drop)
        })?;
        Ok(data)
    }

    /// Simulates as many robots as groups, and returns the time in nanoseconds.
    pub fn launch(
        &mut self,
        capacity: Capacity,
        constants: &Constants,
        groups: usize,
        arguments: &Arguments<'_>,
    ) -> Result<u64, DeviceError> {
        let group = self.card.group(capacity, groups);
        let size = (capacity, group);
        let commands = self.commands.as_mut().expect(PRESENT);
        if let Entry::Vacant(place) = commands.kernels.entry(size) {
            place.insert(self.card.kernel(size, constants)?);
        }
        let Arguments { robots, bodies, plan, stiffness, targets, state, centers, outcomes, .. } = arguments;
        self.with(|commands| {
            let kernel = &commands.kernels[&size];
            let (items, of_group) = ([groups * group], [group]);
            let started = Instant::now();
            // SAFETY: the arguments are those of the kernel, in its order, and both sizes have one dimension. The
            // kernel stays within the buffers, because `DeviceRuns` makes the lists and the buffers from the same
            // plans.
            let event = unsafe {
                kernel.set_arg(0, robots.buffer())?;
                kernel.set_arg(1, bodies.buffer())?;
                kernel.set_arg(2, plan.buffer())?;
                kernel.set_arg(3, stiffness.buffer())?;
                kernel.set_arg(4, targets.buffer())?;
                kernel.set_arg(5, &arguments.channels)?;
                kernel.set_arg(6, &arguments.world_width)?;
                kernel.set_arg(7, &arguments.window)?;
                kernel.set_arg(8, state[0].buffer())?;
                kernel.set_arg(9, state[1].buffer())?;
                kernel.set_arg(10, state[2].buffer())?;
                kernel.set_arg(11, centers.buffer())?;
                kernel.set_arg(12, outcomes.buffer())?;
                let (items, of_group) = (items.as_ptr(), of_group.as_ptr());
                commands.queue.enqueue_nd_range_kernel(kernel.get(), 1, ptr::null(), items, of_group, &[])
            }?;
            commands.queue.flush()?;
            wait(&event)?;
            Ok(started.elapsed().as_nanos() as u64)
        })
    }

    fn with<T>(&self, call: impl FnOnce(&Commands) -> Result<T, ClError>) -> Result<T, DeviceError> {
        self.card.check()?;
        call(self.commands.as_ref().expect(PRESENT)).map_err(|error| self.card.fail(error))
    }
}

impl Drop for CardQueue<'_> {
    fn drop(&mut self) {
        let commands = self.commands.take();
        if self.card.is_lost() {
            mem::forget(commands);
        } else {
            self.card.lock().spare.extend(commands);
        }
    }
}

impl<T: Plain> CardMemory<T> {
    pub fn count(&self) -> usize {
        self.count
    }

    /// The bytes of the buffer for so many numbers: sizes are few, so that buffers can be used again.
    fn bytes(count: usize) -> usize {
        (count * size_of::<T>()).next_power_of_two()
    }

    fn buffer(&self) -> &Buffer<u8> {
        self.buffer.as_ref().expect("a memory has its buffer until it is dropped")
    }

    fn buffer_mut(&mut self) -> &mut Buffer<u8> {
        self.buffer.as_mut().expect("a memory has its buffer until it is dropped")
    }
}

impl<T: Plain> Drop for CardMemory<T> {
    fn drop(&mut self) {
        self.storage.lock().entry(Self::bytes(self.count)).or_default().extend(self.buffer.take());
    }
}

impl Storage {
    fn take(&self, bytes: usize) -> Option<Buffer<u8>> {
        self.lock().get_mut(&bytes)?.pop()
    }

    fn release(&self) {
        let spare = mem::take(&mut *self.lock());
        if self.is_lost() {
            mem::forget(spare);
        }
    }

    fn is_lost(&self) -> bool {
        self.lost.load(Ordering::Relaxed)
    }

    fn lock(&self) -> MutexGuard<'_, BTreeMap<usize, Vec<Buffer<u8>>>> {
        self.spare.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Drop for Storage {
    fn drop(&mut self) {
        self.release();
    }
}

fn wait(event: &Event) -> Result<(), ClError> {
    loop {
        match event.command_execution_status()?.0 {
            CL_COMPLETE => return Ok(()),
            failed if failed < 0 => return Err(ClError(failed)),
            _ => thread::sleep(POLL),
        }
    }
}

fn failure(device: &str, error: ClError) -> DeviceError {
    let device = device.to_owned();
    match error.0 {
        CL_MEM_OBJECT_ALLOCATION_FAILURE | CL_INVALID_BUFFER_SIZE | CL_OUT_OF_HOST_MEMORY => {
            DeviceError::OutOfMemory { device }
        }
        _ => DeviceError::Lost { device, reason: error.to_string() },
    }
}
