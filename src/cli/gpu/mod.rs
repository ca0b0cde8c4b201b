//! OpenCL devices: `nbc devices`, the device that a command uses, and its speed.

pub(in crate::cli) mod devices;
mod open_device;
mod speed;
pub(in crate::cli) mod wording;

pub use devices::DevicesArguments;
pub use open_device::OpenDevice;
pub use speed::DeviceFigures;
