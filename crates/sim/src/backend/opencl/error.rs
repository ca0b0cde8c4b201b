//! Errors of devices, as data.

/// The reason why a device cannot simulate. Names of devices and reasons are those of the driver.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum DeviceError {
    NoDriver,
    NoDevice,
    UnknownDevice { number: usize, devices: usize },
    NoDoubles { device: String },
    Rejected { device: String, log: String },
    Differs { device: String },
    OutOfMemory { device: String },
    Lost { device: String, reason: String },
}
