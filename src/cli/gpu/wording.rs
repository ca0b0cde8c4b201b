//! Messages of devices.

use nbc_base::diag::{Code, Diagnostic, Severity};
use nbc_sim::DeviceError;

pub(in crate::cli) fn device_failure(error: &DeviceError) -> Diagnostic {
    let processor = "`--device cpu` simulates on this processor, with the same results";
    let (message, help) = match error {
        DeviceError::NoDriver => (
            "no OpenCL driver was found".to_owned(),
            "install the driver of the card, or `pocl-opencl-icd` for this processor; docs/gpu.md says how",
        ),
        DeviceError::NoDevice => ("the OpenCL driver has no device".to_owned(), processor),
        DeviceError::UnknownDevice { number, devices } => (
            format!("there is no device `gpu:{number}`, expected a number below {devices}"),
            "`nbc devices` lists them",
        ),
        DeviceError::NoDoubles { device } => (format!("`{device}` has no numbers of double precision"), processor),
        DeviceError::Rejected { device, log } => {
            (format!("the driver of `{device}` cannot compile the kernel: {}", log.trim()), processor)
        }
        DeviceError::Differs { device } => {
            (format!("the results of `{device}` are not those of this processor"), processor)
        }
        DeviceError::OutOfMemory { device } => {
            (format!("`{device}` has not enough free memory"), "end other programs that use it")
        }
        DeviceError::Lost { device, reason } => (format!("`{device}` failed: {reason}"), processor),
    };
    Diagnostic::without_place(Code::BadValue, message).with_help(help)
}

/// A device that cannot be used, whose work this processor does instead.
pub(in crate::cli) fn device_warning(error: &DeviceError) -> Diagnostic {
    let help = "this processor simulates instead, with the same results";
    Diagnostic { severity: Severity::Warning, ..device_failure(error) }.with_help(help)
}
