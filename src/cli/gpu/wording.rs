//! Errors of devices and their messages.

use nbc_base::diag::{Code, Diagnostic, Severity};
use nbc_sim::DeviceError;

/// A device that the user asked for and that cannot be used.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(in crate::cli) struct DeviceFailure(pub(in crate::cli) DeviceError);

impl From<DeviceFailure> for Diagnostic {
    fn from(DeviceFailure(error): DeviceFailure) -> Self {
        let fault = |message: String, help: &str| Self::without_place(Code::BadValue, message).with_help(help);
        let processor = "`--device cpu` simulates on this processor, with the same results";
        match error {
            DeviceError::NoDriver => fault(
                "no OpenCL driver was found".to_owned(),
                "install the driver of the card, or `pocl-opencl-icd` for this processor; docs/gpu.md says how",
            ),
            DeviceError::NoDevice => fault("the OpenCL driver has no device".to_owned(), processor),
            DeviceError::UnknownDevice { number, devices } => fault(
                format!("there is no device `gpu:{number}`, expected a number below {devices}"),
                "`nbc devices` lists them",
            ),
            DeviceError::NoDoubles { device } => {
                fault(format!("`{device}` has no numbers of double precision"), processor)
            }
            DeviceError::Rejected { device, log } => {
                fault(format!("the driver of `{device}` cannot compile the kernel: {}", log.trim()), processor)
            }
            DeviceError::Differs { device } => {
                fault(format!("the results of `{device}` are not those of this processor"), processor)
            }
            DeviceError::OutOfMemory { device } => {
                fault(format!("`{device}` has not enough free memory"), "end other programs that use it")
            }
            DeviceError::Lost { device, reason } => fault(format!("`{device}` failed: {reason}"), processor),
        }
    }
}

/// A device that cannot be used, whose work this processor does instead.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(in crate::cli) struct DeviceWarning(pub(in crate::cli) DeviceError);

impl From<DeviceWarning> for Diagnostic {
    fn from(DeviceWarning(error): DeviceWarning) -> Self {
        let message = Self::from(DeviceFailure(error)).message;
        let warning = Self::without_place(Code::BadValue, message);
        Self {
            severity: Severity::Warning,
            ..warning.with_help("this processor simulates instead, with the same results")
        }
    }
}
