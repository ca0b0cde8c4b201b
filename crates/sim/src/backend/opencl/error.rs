//! Errors of devices, as data.

/// The reason why a device cannot simulate. Names are those that the driver tells.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum DeviceError {
    NoDriver,
    NoDevice,
    UnknownDevice {
        number: usize,
        devices: usize,
    },
    NoDoubles {
        device: String,
    },
    Rejected {
        device: String,
        log: String,
    },
    Differs {
        device: String,
    },
    OutOfMemory {
        device: String,
    },
    Lost {
        device: String,
        /// The driver's name of the error.
        reason: String,
    },
}
