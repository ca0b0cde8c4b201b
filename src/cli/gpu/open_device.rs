//! The device that `--device` chose, opened.

use crate::cli::gpu::speed::{DeviceFigures, measure};
use crate::cli::gpu::wording::{device_failure, device_warning};
use crate::cli::options::device::{DeviceArguments, DeviceChoice};
use crate::cli::{Context, Failure};
use nbc_base::source::Sources;
use nbc_sim::{DeviceError, DeviceKind, LaneBackend, OpenClBackend, OpenClDevice, Simulator};

/// The processor, or a device with the processor for what it cannot do.
#[derive(Clone)]
pub struct OpenDevice {
    processor: LaneBackend,
    /// Whether the device's failure ends the command; otherwise the processor takes over.
    device: Option<(OpenClBackend, bool)>,
}

impl OpenDevice {
    pub fn open(arguments: DeviceArguments, processor: LaneBackend, context: &Context) -> Result<Self, Failure> {
        let device = match arguments.device {
            DeviceChoice::Processor => None,
            DeviceChoice::Device(number) => {
                let opened = numbered(number).and_then(|device| OpenClBackend::open(&device, processor.clone()));
                Some((opened.map_err(|error| device_failure(&error))?, true))
            }
            DeviceChoice::Auto => first_card(&processor, context).map(|backend| (backend, false)),
        };
        Ok(Self { processor, device })
    }

    pub fn simulator(&self) -> Simulator {
        match &self.device {
            Some((backend, _)) => Simulator::new(backend.clone()),
            None => Simulator::new(self.processor.clone()),
        }
    }

    pub fn is_device(&self) -> bool {
        self.device.is_some()
    }

    pub fn check(&self) -> Result<(), Failure> {
        match &self.device {
            Some((backend, true)) => backend.failure().map_or(Ok(()), |error| Err(device_failure(&error).into())),
            _ => Ok(()),
        }
    }

    /// Also warns if this processor had to take over.
    pub fn end(&self, context: &Context) -> Result<(), Failure> {
        self.check()?;
        if let Some(error) = self.device.as_ref().and_then(|(backend, _)| backend.failure()) {
            context.tell(&[device_warning(&error)], &Sources::default());
        }
        Ok(())
    }

    pub fn figures(&self) -> Option<DeviceFigures> {
        self.device.as_ref().map(|(backend, _)| measure(backend))
    }
}

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
            Err(error) => context.tell(&[device_warning(&error)], &Sources::default()),
        }
    }
    None
}
