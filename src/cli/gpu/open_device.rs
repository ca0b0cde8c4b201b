//! The device that `--device` chose, opened.

use crate::cli::gpu::speed::{DeviceFigures, measure};
use crate::cli::gpu::wording::{DeviceFailure, DeviceWarning};
use crate::cli::options::device::DeviceChoice;
use crate::cli::{Context, Failure};
use nbc_base::source::Sources;
use nbc_sim::{DeviceError, DeviceKind, LaneBackend, OpenClBackend, OpenClDevice, Simulator};

/// What simulates the robots of a command: the processor, or a device with the processor for what it cannot do.
#[derive(Clone)]
pub struct OpenDevice {
    processor: LaneBackend,
    /// The device, and whether its failure ends the command; otherwise the processor takes over.
    device: Option<(OpenClBackend, bool)>,
}

impl OpenDevice {
    /// Opens the chosen device; `processor` simulates if none is chosen, and what the device cannot simulate.
    pub fn open(choice: DeviceChoice, processor: LaneBackend, context: &Context) -> Result<Self, Failure> {
        let device = match choice {
            DeviceChoice::Processor => None,
            DeviceChoice::Device(number) => {
                let opened = numbered(number).and_then(|device| OpenClBackend::open(&device, processor.clone()));
                Some((opened.map_err(DeviceFailure)?, true))
            }
            DeviceChoice::Auto => first_card(&processor, context).map(|backend| (backend, false)),
        };
        Ok(Self { processor, device })
    }

    /// A simulator on the device.
    pub fn simulator(&self) -> Simulator {
        match &self.device {
            Some((backend, _)) => Simulator::new(backend.clone()),
            None => Simulator::new(self.processor.clone()),
        }
    }

    /// Whether a device was opened.
    pub fn is_device(&self) -> bool {
        self.device.is_some()
    }

    /// Checks that the device has not failed.
    pub fn check(&self) -> Result<(), Failure> {
        match &self.device {
            Some((backend, true)) => backend.failure().map_or(Ok(()), |error| Err(DeviceFailure(error).into())),
            _ => Ok(()),
        }
    }

    /// Checks the same at the end of a command, and warns if this processor had to take over.
    pub fn end(&self, context: &Context) -> Result<(), Failure> {
        self.check()?;
        if let Some(error) = self.device.as_ref().and_then(|(backend, _)| backend.failure()) {
            context.tell(&[DeviceWarning(error).into()], &Sources::default());
        }
        Ok(())
    }

    /// The speed of the device, if there is one.
    pub fn figures(&self) -> Option<DeviceFigures> {
        self.device.as_ref().map(|(backend, _)| measure(backend))
    }
}

/// The device with that number.
pub(super) fn numbered(number: usize) -> Result<OpenClDevice, DeviceError> {
    let devices = OpenClDevice::all()?;
    let count = devices.len();
    if count == 0 {
        return Err(DeviceError::NoDevice);
    }
    devices.into_iter().nth(number).ok_or(DeviceError::UnknownDevice { number, devices: count })
}

/// The first graphics card that can simulate. Warns of those that cannot.
fn first_card(processor: &LaneBackend, context: &Context) -> Option<OpenClBackend> {
    let devices = OpenClDevice::all().unwrap_or_default();
    for device in devices.iter().filter(|device| device.kind == DeviceKind::Graphics) {
        match OpenClBackend::open(device, processor.clone()) {
            Ok(backend) => return Some(backend),
            Err(error) => context.tell(&[DeviceWarning(error).into()], &Sources::default()),
        }
    }
    None
}
