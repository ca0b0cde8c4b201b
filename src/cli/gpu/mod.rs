//! OpenCL devices: the choice of one, their list, and their speed.

mod chosen;
mod devices;

mod speed;

pub use chosen::OpenDevice;
pub use devices::DevicesArguments;
pub use speed::DeviceFigures;
