//! Errors of devices, as data.

/// The reason why a device cannot simulate. Names are those that the driver tells.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum DeviceError {
    /// There is no OpenCL loader, or no driver.
    NoDriver,
    /// A driver is there, but no device.
    NoDevice,
    /// A number that no device has.
    UnknownDevice {
        /// The number asked for.
        number: usize,
        /// The number of devices.
        devices: usize,
    },
    /// A device without numbers of double precision.
    NoDoubles {
        /// The device.
        device: String,
    },
    /// A driver that cannot compile the kernel.
    Rejected {
        /// The device.
        device: String,
        /// What its compiler says.
        log: String,
    },
    /// A device whose results are not those of this processor.
    Differs {
        /// The device.
        device: String,
    },
    /// A device without enough memory.
    OutOfMemory {
        /// The device.
        device: String,
    },
    /// A device that failed while it worked.
    Lost {
        /// The device.
        device: String,
        /// The driver's name of the error.
        reason: String,
    },
}
